#include "model/import/import_ply_header.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <array>

namespace triptych {

namespace {

PlyType read_type(std::string_view word, const ImportReader& reader) {
  static constexpr std::array<std::string_view, 8> names = {"char", "uchar", "short", "ushort",
                                                            "int",  "uint",  "float", "double"};
  static constexpr std::array<std::string_view, 8> sized = {"int8",  "uint8",  "int16",   "uint16",
                                                            "int32", "uint32", "float32", "float64"};
  for (size_t i = 0; i < names.size(); ++i) {
    if (word == names[i] || word == sized[i]) return static_cast<PlyType>(i);
  }
  fail(reader.line_place(), "\"{}\" is not a type of properties", word.substr(0, 40));
}

PlyProperty read_property(std::string_view line, const ImportReader& reader) {
  PlyProperty property;
  std::string_view word = take_word(line);
  if (word == "list") {
    property.count_type = read_type(take_word(line), reader);
    if (*property.count_type >= PlyType::float32)
      fail(reader.line_place(), "a list's length must be an integer");
    word = take_word(line);
  }
  property.type = read_type(word, reader);
  property.name = std::string(take_word(line));
  if (property.name.empty()) fail(reader.line_place(), "a property without a name");
  return property;
}

PlyElement read_element(std::string_view line, const ImportReader& reader) {
  PlyElement element;
  element.name = std::string(take_word(line));
  const auto count = to_integer(take_word(line));
  if (element.name.empty() || !count || *count < 0)
    fail(reader.line_place(), "an element needs a name and a count");
  element.count = static_cast<uint64_t>(*count);
  return element;
}

PlyEncoding read_encoding(std::string_view line, const ImportReader& reader) {
  const std::string_view encoding = take_word(line);
  const std::string_view version = take_word(line);
  if (!version.empty() && !version.starts_with("1."))
    fail(reader.line_place(), "version \"{}\" is not known", version.substr(0, 40));
  if (encoding == "ascii") return PlyEncoding::ascii;
  if (encoding == "binary_little_endian") return PlyEncoding::little_endian;
  if (encoding == "binary_big_endian") return PlyEncoding::big_endian;
  fail(reader.line_place(), "format \"{}\" is not known", encoding.substr(0, 40));
}

/// The least size of one record of the element, bytes.
uint64_t min_record_bytes(const PlyElement& element, PlyEncoding encoding) {
  uint64_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += encoding == PlyEncoding::ascii ? 2 : scalar_bytes(property.count_type.value_or(property.type));
  }
  return bytes;
}

void check_promises(const PlyHeader& header, const ImportReader& reader) {
  uint64_t left =
      reader.left() + (header.encoding == PlyEncoding::ascii ? 1 : 0);  // the last line may have no line end
  for (const PlyElement& element : header.elements) {
    const uint64_t record = min_record_bytes(element, header.encoding);
    if (element.count == 0) continue;
    if (record == 0) fail(reader.line_place(), "element \"{}\" has no properties", element.name);
    if (element.count > left / record) {
      fail(reader.line_place(), "promises {} of element \"{}\", but the file has only {} bytes left",
           element.count, element.name, left);
    }
    left -= element.count * record;
  }
}

}  // namespace

std::optional<size_t> PlyElement::find(std::initializer_list<const char*> names) const {
  for (size_t i = 0; i < properties.size(); ++i) {
    if (std::find(names.begin(), names.end(), properties[i].name) != names.end()) return i;
  }
  return std::nullopt;
}

std::optional<uint64_t> PlyElement::record_bytes() const {
  uint64_t bytes = 0;
  for (const PlyProperty& property : properties) {
    if (property.count_type) return std::nullopt;
    bytes += scalar_bytes(property.type);
  }
  return bytes;
}

PlyHeader read_ply_header(ImportReader& reader) {
  std::string_view line;
  if (!reader.next_line(line) || trimmed(line) != "ply")
    fail(fmt::format("{}", reader.line_place()), "is not a PLY file: it does not begin with \"ply\"");
  PlyHeader header;
  bool formatted = false;
  while (reader.next_line(line)) {
    const std::string_view word = take_word(line);
    if (word == "comment" || word == "obj_info" || word.empty()) continue;
    if (word == "format") {
      header.encoding = read_encoding(line, reader);
      formatted = true;
    } else if (word == "element") {
      header.elements.push_back(read_element(line, reader));
    } else if (word == "property") {
      if (header.elements.empty()) fail(reader.line_place(), "a property before the first element");
      header.elements.back().properties.push_back(read_property(line, reader));
    } else if (word == "end_header") {
      if (!formatted) fail(reader.line_place(), "the header names no format");
      check_promises(header, reader);
      return header;
    } else {
      ++header.unknown_statements;
    }
  }
  fail(reader.line_place(), "the file ends within its header");
}

}  // namespace triptych
