#include "view/bcf/xml_tree.hpp"

#include "base/error.hpp"
#include "base/xml_fault.hpp"

#include <algorithm>
#include <memory>

namespace triptych {

namespace {

constexpr size_t most_depth = 64, most_elements = 1'000'000;

std::string local_name(const char* name) {
  const std::string_view whole(name);
  return std::string(whole.substr(whole.find(':') + 1));  // npos + 1 is 0
}

std::string trimmed(const std::string& text) {
  constexpr const char* blanks = " \t\r\n";
  const size_t begin = text.find_first_not_of(blanks);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

struct Reading {
  XML_Parser parser;
  XmlElement root;                ///< holds the outermost element
  std::vector<XmlElement*> open;  ///< from the root on
  size_t elements = 0;
  const char* why = nullptr;  ///< it was stopped

  void stop(const char* reason) {
    why = reason;
    XML_StopParser(parser, XML_FALSE);
  }
};

Reading& of(void* user) { return *static_cast<Reading*>(user); }

void begin(void* user, const char* name, const char** attributes) {
  Reading& reading = of(user);
  if (reading.open.size() > most_depth) return reading.stop("too many elements within each other");
  if (++reading.elements > most_elements) return reading.stop("too many elements");
  XmlElement& parent = *reading.open.back();
  parent.children.push_back({local_name(name), {}, {}, {}});
  XmlElement& element = parent.children.back();
  for (; *attributes; attributes += 2) element.attributes[local_name(attributes[0])] = attributes[1];
  reading.open.push_back(&element);
}

void end(void* user, const char*) {
  Reading& reading = of(user);
  if (reading.why) return;
  reading.open.back()->text = trimmed(reading.open.back()->text);
  reading.open.pop_back();
}

void take_text(void* user, const char* text, int count) {
  of(user).open.back()->text.append(text, static_cast<size_t>(count));
}

void refuse_types(void* user, const char*, const char*, const char*, int) {
  of(user).stop("a document type definition, which no viewpoint needs");
}

}  // namespace

const XmlElement* XmlElement::child(std::string_view of_name) const {
  const auto found = std::find_if(children.begin(), children.end(),
                                  [&](const XmlElement& element) { return element.name == of_name; });
  return found == children.end() ? nullptr : &*found;
}

std::vector<const XmlElement*> XmlElement::all(std::string_view of_name) const {
  std::vector<const XmlElement*> found;
  for (const XmlElement& element : children) {
    if (element.name == of_name) found.push_back(&element);
  }
  return found;
}

std::string XmlElement::attribute(const std::string& of_name) const {
  const auto found = attributes.find(of_name);
  return found == attributes.end() ? "" : found->second;
}

XmlElement parse_xml(std::string_view text, const std::string& place) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr),
                                                                            XML_ParserFree);
  if (!parser) fail(place, "there is no memory to read it");
  Reading reading{parser.get(), {}, {}};
  reading.open.push_back(&reading.root);
  XML_SetUserData(parser.get(), &reading);
  XML_SetElementHandler(parser.get(), begin, end);
  XML_SetCharacterDataHandler(parser.get(), take_text);
  XML_SetStartDoctypeDeclHandler(parser.get(), refuse_types);
  const auto status = XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), 1);
  if (reading.why) fail(place, "line {}: {}", XML_GetCurrentLineNumber(parser.get()), reading.why);
  if (status != XML_STATUS_OK) throw Error(place, xml_fault(parser.get()));
  return std::move(reading.root.children.front());
}

std::string xml_text(std::string_view text) {
  std::string safe;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:  // control characters are not allowed
        safe += static_cast<unsigned char>(letter) < ' ' ? ' ' : letter;
    }
  }
  return safe;
}

}  // namespace triptych
