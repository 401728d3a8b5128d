// Java properties files, as furniture catalogues are written.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace triptych {

/// Keys and values (UTF-8) of the text of a `.properties` file: Latin-1 with \uXXXX, \t, \n, \r, \f and
/// \<any> escapes, comments after # or !, `=`, `:` or blanks between key and value, lines that end in a
/// backslash go on. The last of several equal keys counts. Error (place, line) for a broken \u escape.
std::map<std::string, std::string> parse_properties(std::string_view text, const std::string& place);

}  // namespace triptych
