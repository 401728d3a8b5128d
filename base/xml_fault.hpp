// What is wrong with XML, in plain words.
#pragma once

#include <expat.h>
#include <fmt/core.h>
#include <string>

namespace triptych {

/// Why a document is no XML: "it ends before its last element is closed".
std::string in_words(XML_Error error);

/// Where and why the parser stopped: "line 3, column 14: is no XML: …". Links with expat where it is used.
inline std::string xml_fault(XML_Parser parser) {
  return fmt::format("line {}, column {}: is no XML: {}", XML_GetCurrentLineNumber(parser),
                     XML_GetCurrentColumnNumber(parser) + 1, in_words(XML_GetErrorCode(parser)));
}

}  // namespace triptych
