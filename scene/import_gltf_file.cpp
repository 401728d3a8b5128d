// From the bytes of a .gltf or .glb file to tinygltf's model. The one source file that holds tinygltf's code.
#define TINYGLTF_IMPLEMENTATION
#include "base/error.hpp"
#include "base/file.hpp"
#include "scene/import_gltf.hpp"

#include <cstring>
#include <limits>

namespace triptych {

namespace {

/// Parsers recurse into nested values; a file nested as deeply as this is no model.
constexpr int deepest_nesting = 200;

void check_nesting(std::string_view json, const std::string& place) {
  int depth = 0;
  bool in_text = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char letter = json[i];
    if (in_text) {
      if (letter == '\\') {
        ++i;
      } else if (letter == '"') {
        in_text = false;
      }
    } else if (letter == '"') {
      in_text = true;
    } else if (letter == '[' || letter == '{') {
      if (++depth > deepest_nesting)
        fail(place, "byte {}: JSON nested deeper than {} levels", i, deepest_nesting);
    } else if (letter == ']' || letter == '}') {
      --depth;
    }
  }
}

uint32_t word_at(std::string_view bytes, size_t offset) {
  uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof(word));
  return word;
}

/// The JSON within a binary glTF file, whose container is checked to the byte.
std::string_view glb_json(std::string_view bytes, const std::string& place) {
  constexpr uint32_t json_kind = 0x4e4f534a, binary_kind = 0x004e4942;
  if (bytes.size() < 20) fail(place, "the file ends within its header of 20 bytes");
  if (word_at(bytes, 4) != 2) fail(place, "is binary glTF of version {}; only 2 is known", word_at(bytes, 4));
  if (word_at(bytes, 8) != bytes.size())
    fail(place, "says that it holds {} bytes, but has {}", word_at(bytes, 8), bytes.size());
  const uint64_t json_bytes = word_at(bytes, 12);
  if (word_at(bytes, 16) != json_kind) fail(place, "byte 16: the first chunk is not JSON");
  if (json_bytes == 0 || json_bytes > bytes.size() - 20)
    fail(place, "byte 12: a chunk of {} bytes goes beyond the file", json_bytes);
  if (json_bytes % 4 != 0) fail(place, "byte 12: a chunk of {} bytes is not a multiple of 4", json_bytes);
  const uint64_t next = 20 + json_bytes, left = bytes.size() - next;
  if (left > 0) {
    if (left < 12) fail(place, "byte {}: the file ends within a chunk", next);
    const uint64_t binary_bytes = word_at(bytes, next);
    if (word_at(bytes, next + 4) != binary_kind)
      fail(place, "byte {}: the second chunk is not binary data", next);
    if (binary_bytes > left - 8)
      fail(place, "byte {}: a chunk of {} bytes goes beyond the file", next, binary_bytes);
  }
  return bytes.substr(20, json_bytes);
}

/// Messages of tinygltf may have many lines and repeat whole data URIs.
std::string one_line(std::string message) {
  while (!message.empty() && (message.back() == '\n' || message.back() == ' ')) message.pop_back();
  if (message.size() > 160) message = message.substr(0, 120) + " ...";
  for (char& letter : message) {
    if (static_cast<unsigned char>(letter) < ' ') letter = ' ';
  }
  return message.empty() ? "does not parse" : message;
}

/// tinygltf looks for buffers in the working folder too; a model means the files beside it, and those alone.
bool is_file_beside(const std::string& path, void*) {
  std::error_code error;
  return !path.starts_with("./") && std::filesystem::is_regular_file(path, error);
}

bool read_bytes(std::vector<unsigned char>* bytes, std::string* message, const std::string& path, void*) {
  try {
    const std::vector<std::byte> contents = read_file(path);
    bytes->resize(contents.size());
    if (!contents.empty()) std::memcpy(bytes->data(), contents.data(), contents.size());
    return true;
  } catch (const Error& error) {
    *message = error.what();
    return false;
  }
}

/// Images are not drawn: their bytes are passed over.
bool skip_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                void*) {
  return true;
}

void check_extensions(const tinygltf::Model& gltf, FileImport& target) {
  for (const std::string& name : gltf.extensionsRequired) {
    if (name == "KHR_mesh_quantization" || name == "EXT_mesh_gpu_instancing" || name == "KHR_lights_punctual")
      continue;
    if (!name.starts_with("KHR_materials_") && !name.starts_with("KHR_texture_") &&
        !name.starts_with("EXT_texture_")) {
      fail(target.place(), "requires the extension {}, which is not supported", name.substr(0, 80));
    }
    target.warn(fmt::format("extension is required that is not drawn yet: {}", name));
  }
}

}  // namespace

tinygltf::Model load_gltf(FileImport& target) {
  const std::string place = target.place();
  const std::string bytes = read_text_file(target.file());
  if (bytes.size() > std::numeric_limits<uint32_t>::max())
    fail(place, "is larger than the 4 GiB that glTF can hold");
  const bool binary = bytes.starts_with("glTF");
  check_nesting(binary ? glb_json(bytes, place) : bytes, place);
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(skip_image, nullptr);
  loader.SetFsCallbacks(
      {is_file_beside, tinygltf::ExpandFilePath, read_bytes, tinygltf::WriteWholeFile, nullptr});
  const std::string folder = std::filesystem::absolute(target.file()).parent_path().string();
  const auto size = static_cast<unsigned>(bytes.size());
  tinygltf::Model gltf;
  std::string errors, warnings;
  bool parsed = false;
  try {
    parsed = binary ? loader.LoadBinaryFromMemory(&gltf, &errors, &warnings,
                                                  reinterpret_cast<const unsigned char*>(bytes.data()), size,
                                                  folder)
                    : loader.LoadASCIIFromString(&gltf, &errors, &warnings, bytes.data(), size, folder);
  } catch (const std::exception& error) {  // tinygltf and its JSON throw on some values of the wrong type
    fail(place, "{}", one_line(error.what()));
  }
  // tinygltf passes over primitives that it does not understand, but says so.
  if (!parsed || !errors.empty()) fail(place, "{}", one_line(errors));
  check_extensions(gltf, target);
  return gltf;
}

}  // namespace triptych
