// Small XML documents as trees (expat).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

struct XmlElement {
  std::string name;  ///< without its namespace's prefix
  std::map<std::string, std::string> attributes;
  std::string text;  ///< all that stands in it outside of other elements, without blanks around it
  std::vector<XmlElement> children;

  /// The first child of that name; null where there is none.
  const XmlElement* child(std::string_view of_name) const;
  /// All of them.
  std::vector<const XmlElement*> all(std::string_view of_name) const;
  /// An attribute; empty where it is missing.
  std::string attribute(const std::string& of_name) const;
};

/// The document's outermost element. Error (place, line) for what is no XML, for document type definitions,
/// for more than 64 elements within each other and for more than a million of them.
XmlElement parse_xml(std::string_view text, const std::string& place);

/// A text as it stands in XML, between elements or in an attribute.
std::string xml_text(std::string_view text);

}  // namespace triptych
