#include "scene/pack_options.hpp"

#include "base/bytes.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// Small letters, digits and dashes.
bool is_name(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') || letter == '-';
  });
}

/// Printable ASCII.
bool is_value(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char letter) { return letter >= ' ' && letter <= '~'; });
}

}  // namespace

std::vector<std::byte> encode_pack_options(const PackOptions& options) {
  ByteWriter writer;
  writer.write(static_cast<uint32_t>(options.size()));
  for (const auto& [name, value] : options) {
    writer.write_text(name);
    writer.write_text(value);
  }
  decode_pack_options(writer.bytes(), "the options of the build");
  return std::move(writer.bytes());
}

PackOptions decode_pack_options(std::span<const std::byte> bytes, const std::string& place) {
  if (bytes.size() > max_pack_options_bytes)
    fail(place, "has {} bytes, more than {}", bytes.size(), max_pack_options_bytes);
  ByteReader reader(bytes, place);
  PackOptions options;
  for (auto left = reader.read<uint32_t>(); left > 0; --left) {
    const size_t at = reader.offset();
    const std::string name = reader.read_text(), value = reader.read_text();
    if (!is_name(name)) fail(place, "byte {}: what names an option is no flag's name", at);
    if (!options.empty() && name <= options.rbegin()->first)
      fail(place, "byte {}: option \"{}\" does not come behind \"{}\"", at, name, options.rbegin()->first);
    if (!is_value(value)) fail(place, "byte {}: option \"{}\" is not printable", at, name);
    options.emplace_hint(options.end(), name, value);
  }
  reader.expect_end();
  return options;
}

bool has_word(const PackOptions& options, const std::string& option, std::string_view word) {
  const auto found = options.find(option);
  if (found == options.end()) return false;
  const std::string words = "," + found->second + ",";
  return words.find("," + std::string(word) + ",") != std::string::npos;
}

}  // namespace triptych
