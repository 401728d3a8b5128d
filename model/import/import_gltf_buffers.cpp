// The buffers of a glTF file: found, and left where they are.
#include "base/error.hpp"
#include "base/one_line.hpp"
#include "model/import/beside.hpp"
#include "model/import/import_gltf.hpp"

#include <cctype>
#include <nlohmann/json.hpp>

namespace triptych {

namespace {

/// Parsers recurse into nested values; no model is nested as deeply as this.
constexpr int max_nesting = 200;

/// A member of the outermost object: its name and where its value is.
struct Member {
  std::string_view name;
  size_t begin, end;
};

/// Finds members without parsing their values. Text that is not JSON gives some members or none.
std::vector<Member> outermost_members(std::string_view json, const std::string& place) {
  std::vector<Member> members;
  std::string_view text;  // the last at the first level
  int depth = 0;
  bool in_value = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char letter = json[i];
    if (letter == '"') {
      const size_t begin = i + 1;
      for (++i; i < json.size() && json[i] != '"'; ++i) i += json[i] == '\\';
      if (depth == 1 && !in_value) text = json.substr(begin, std::min(i, json.size()) - begin);
    } else if (letter == '[' || letter == '{') {
      if (++depth > max_nesting) fail(place, "byte {}: JSON nested deeper than {} levels", i, max_nesting);
    } else if (letter == ':' && depth == 1 && !in_value) {
      members.push_back({text, i + 1, json.size()});
      in_value = true;
    } else if (letter == ']' || letter == '}' || letter == ',') {
      const bool ends = in_value && depth == 1;
      if (letter != ',') --depth;
      if (!ends) continue;
      members.back().end = i;
      in_value = false;
    }
  }
  return members;
}

int hexadecimal(char digit) {
  if (digit >= '0' && digit <= '9') return digit - '0';
  const int letter = std::tolower(static_cast<unsigned char>(digit));
  return letter >= 'a' && letter <= 'f' ? letter - 'a' + 10 : -1;
}

/// "a%20b" to "a b".
std::string without_percents(const std::string& uri) {
  std::string text;
  for (size_t i = 0; i < uri.size(); ++i) {
    const bool coded =
        uri[i] == '%' && i + 2 < uri.size() && hexadecimal(uri[i + 1]) >= 0 && hexadecimal(uri[i + 2]) >= 0;
    text += coded ? static_cast<char>(hexadecimal(uri[i + 1]) * 16 + hexadecimal(uri[i + 2])) : uri[i];
    if (coded) i += 2;
  }
  return text;
}

/// Base64 with blanks in it, of either alphabet, with or without its padding; nothing where it holds other
/// letters.
std::optional<std::vector<std::byte>> from_base64(std::string_view text) {
  std::vector<std::byte> bytes;
  uint32_t bits = 0;
  int count = 0;
  for (const char letter : text) {
    if (letter == '=' || letter == ' ' || letter == '\n' || letter == '\r' || letter == '\t') continue;
    uint32_t value = 0;
    if (letter >= 'A' && letter <= 'Z') {
      value = static_cast<uint32_t>(letter - 'A');
    } else if (letter >= 'a' && letter <= 'z') {
      value = static_cast<uint32_t>(letter - 'a') + 26;
    } else if (letter >= '0' && letter <= '9') {
      value = static_cast<uint32_t>(letter - '0') + 52;
    } else if (letter == '+' || letter == '-') {
      value = 62;
    } else if (letter == '/' || letter == '_') {
      value = 63;
    } else {
      return std::nullopt;
    }
    bits = (bits << 6 | value) & 0xffffff;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> count & 0xff));
  }
  return bytes;
}

}  // namespace

bool is_data_uri(std::string_view uri) {
  return uri.size() >= 5 && equal_but_for_case(uri.substr(0, 5), "data:");
}

std::vector<std::byte> bytes_of_data_uri(const std::string& uri, const std::string& place) {
  const size_t comma = uri.find(',');
  if (comma == std::string::npos) fail(place, "its data URI has no comma, and so no data");
  const bool base64 = uri.substr(0, comma).ends_with(";base64");
  const std::string text = without_percents(uri.substr(comma + 1));
  std::optional<std::vector<std::byte>> data;
  if (base64) {
    data = from_base64(text);
  } else {
    const auto bytes = std::as_bytes(std::span(text));
    data.emplace(bytes.begin(), bytes.end());
  }
  if (!data) fail(place, "its data URI is not base64");
  return std::move(*data);
}

GltfBuffer gltf_file_beside(FileImport& target, const std::string& uri, uint64_t size,
                            const std::string& place) {
  const std::string name = without_percents(uri);
  if (name.empty() || name.find('\0') != std::string::npos) fail(place, "names no file");
  std::shared_ptr<const StreamSource> source = target.beside(name);
  if (!source && name != uri) source = target.beside(uri);  // a name that holds a % of its own
  if (!source) fail(place, "its file is not there: {}", one_line(name.substr(0, 120)));
  if (source->size() < size)
    fail(place, "{} holds {} bytes of {}", one_line(name.substr(0, 80)), source->size(), size);
  return {source, 0, size};
}

namespace {

GltfBuffer from_data_uri(const std::string& uri, uint64_t size, const std::string& place) {
  std::vector<std::byte> data = bytes_of_data_uri(uri, place);
  if (data.size() < size) fail(place, "its data URI holds {} bytes of {}", data.size(), size);
  return {std::make_shared<StreamSource>(place, std::move(data)), 0, size};
}

/// Whether a buffer is only there for readers without meshoptimizer's extension.
bool is_fallback(const nlohmann::json& buffer) {
  const auto extensions = buffer.find("extensions");
  if (extensions == buffer.end() || !extensions->is_object()) return false;
  return extensions->contains("EXT_meshopt_compression") || extensions->contains("KHR_meshopt_compression");
}

}  // namespace

GltfTaken take_buffers(std::string& json, const std::string& place) {
  GltfTaken taken;
  std::string kept;
  size_t copied = 0;
  for (const Member& member : outermost_members(json, place)) {
    if (member.name != "buffers" && member.name != "images") continue;
    (member.name == "buffers" ? taken.buffers : taken.images) =
        json.substr(member.begin, member.end - member.begin);
    kept.append(json, copied, member.begin - copied).append("[]");
    copied = member.end;
  }
  json = kept.append(json, copied);
  return taken;
}

std::vector<std::string> names_in_gltf(const std::string& text, const std::string& place) {
  std::vector<std::string> names;
  for (const Member& member : outermost_members(text, place)) {
    if (member.name != "buffers" && member.name != "images") continue;
    const auto value = text.begin() + static_cast<std::ptrdiff_t>(member.begin);
    const auto list =
        nlohmann::json::parse(value, text.begin() + static_cast<std::ptrdiff_t>(member.end), nullptr, false);
    for (const auto& entry : list) {
      const auto uri = entry.is_object() ? entry.find("uri") : entry.end();
      if (!entry.is_object() || uri == entry.end() || !uri->is_string()) continue;
      if (!is_data_uri(uri->get<std::string>())) names.push_back(without_percents(uri->get<std::string>()));
    }
  }
  return names;
}

std::optional<std::vector<GltfBuffer>> find_buffers(const std::string& json, FileImport& target,
                                                    const std::optional<GltfBuffer>& binary) {
  std::vector<GltfBuffer> buffers;
  if (json.empty()) return buffers;
  const auto list = nlohmann::json::parse(json, nullptr, false);
  if (list.is_discarded()) return std::nullopt;
  if (!list.is_array()) fail(target.place(), "\"buffers\" is not a list");
  for (const auto& entry : list) {
    const std::string place = fmt::format("{}: buffer {}", target.place(), buffers.size());
    const auto length = entry.is_object() ? entry.find("byteLength") : entry.end();
    if (!entry.is_object() || length == entry.end() || !length->is_number_unsigned())
      fail(place, "has no length");
    const auto size = length->get<uint64_t>();
    const auto uri = entry.find("uri");
    if (uri != entry.end() && !uri->is_string()) fail(place, "its URI is not a text");
    if (uri != entry.end()) {
      const auto text = uri->get<std::string>();
      const std::string what = fmt::format("buffer {}", buffers.size());
      try {  // what is in other buffers can be read all the same
        buffers.push_back(is_data_uri(text) ? from_data_uri(text, size, what)
                                            : gltf_file_beside(target, text, size, what));
      } catch (const Error& error) {
        buffers.push_back({nullptr, 0, 0, error.what()});
      }
    } else if (is_fallback(entry)) {
      buffers.emplace_back();  // stands for what is compressed, and holds nothing
    } else {
      if (!binary || !buffers.empty()) fail(place, "has neither an URI nor a chunk of its own");
      if (size > binary->size) fail(place, "is longer than its chunk of {} bytes", binary->size);
      buffers.push_back({binary->source, binary->offset, size});
    }
  }
  return buffers;
}

}  // namespace triptych
