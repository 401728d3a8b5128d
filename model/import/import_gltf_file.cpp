// From the bytes of a .gltf or .glb file to tinygltf's model. The one source file that holds tinygltf's code.
#define TINYGLTF_IMPLEMENTATION
#include "base/error.hpp"
#include "base/one_line.hpp"
#include "model/import/import_gltf.hpp"

#include <algorithm>
#include <limits>

namespace triptych {

namespace {

uint32_t word_at(const SourceReader& reader, uint64_t offset) {
  uint32_t word = 0;
  reader.read(offset, std::as_writable_bytes(std::span(&word, 1)));
  return word;
}

/// The text of a glTF file, and the second chunk of a binary one.
struct Container {
  std::string json;
  std::optional<GltfBuffer> binary;
};

/// The content of a binary glTF file, whose container is checked to the byte.
Container open_binary(const std::shared_ptr<const StreamSource>& source, const SourceReader& reader,
                      const std::string& place) {
  constexpr uint32_t json_kind = 0x4e4f534a, binary_kind = 0x004e4942;
  const uint64_t size = source->size();
  if (size < 20) fail(place, "the file ends within its header of 20 bytes");
  if (word_at(reader, 4) != 2)
    fail(place, "is binary glTF of version {}; only 2 is known", word_at(reader, 4));
  if (word_at(reader, 8) != size)
    fail(place, "says that it holds {} bytes, but has {}", word_at(reader, 8), size);
  const uint64_t json_bytes = word_at(reader, 12);
  if (word_at(reader, 16) != json_kind) fail(place, "byte 16: the first chunk is not JSON");
  if (json_bytes == 0 || json_bytes > size - 20)
    fail(place, "byte 12: a chunk of {} bytes goes beyond the file", json_bytes);
  if (json_bytes % 4 != 0) fail(place, "byte 12: a chunk of {} bytes is not a multiple of 4", json_bytes);
  Container container{std::string(json_bytes, ' '), std::nullopt};
  reader.read(20, std::as_writable_bytes(std::span(container.json)));
  const uint64_t next = 20 + json_bytes, left = size - next;
  if (left == 0) return container;
  if (left < 12) fail(place, "byte {}: the file ends within a chunk", next);
  const uint64_t binary_bytes = word_at(reader, next);
  if (word_at(reader, next + 4) != binary_kind)
    fail(place, "byte {}: the second chunk is not binary data", next);
  if (binary_bytes > left - 8)
    fail(place, "byte {}: a chunk of {} bytes goes beyond the file", next, binary_bytes);
  container.binary = GltfBuffer{source, next + 8, binary_bytes};
  return container;
}

Container open_container(const std::shared_ptr<const StreamSource>& source, const std::string& place) {
  const SourceReader reader(source);
  std::string beginning(std::min<uint64_t>(4, source->size()), ' ');
  reader.read(0, std::as_writable_bytes(std::span(beginning)));
  if (beginning == "glTF") return open_binary(source, reader, place);
  if (source->size() > std::numeric_limits<uint32_t>::max()) fail(place, "is JSON of more than 4 GiB");
  Container container{std::string(source->size(), ' '), std::nullopt};
  reader.read(0, std::as_writable_bytes(std::span(container.json)));
  return container;
}

/// Shortens a message of tinygltf, which may have many lines and repeat whole data URIs.
std::string short_line(std::string message) {
  while (!message.empty() && (message.back() == '\n' || message.back() == ' ')) message.pop_back();
  if (message.size() > 160) message = message.substr(0, 120) + " ...";
  return message.empty() ? "does not parse" : one_line(message);
}

/// Makes sure that tinygltf opens no file: buffers were taken out of its text, and images are not drawn.
bool no_file(const std::string&, void*) { return false; }

bool read_nothing(std::vector<unsigned char>*, std::string* message, const std::string& path, void*) {
  *message = path + " was not expected";
  return false;
}

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

std::vector<std::filesystem::path> files_beside_gltf(const std::filesystem::path& file) {
  const auto container = open_container(std::make_shared<StreamSource>(file), file.string());
  std::vector<std::filesystem::path> files;
  for (const std::string& name : names_in_gltf(container.json, file.string()))
    files.push_back(file.parent_path() / name);
  return files;
}

GltfFile load_gltf(FileImport& target, const std::shared_ptr<const StreamSource>& source) {
  const std::string place = target.place();
  auto [json, binary] = open_container(source, place);
  const std::string buffers = take_buffers(json, place);
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(skip_image, nullptr);
  loader.SetFsCallbacks({no_file, tinygltf::ExpandFilePath, read_nothing, tinygltf::WriteWholeFile, nullptr});
  const std::string folder = std::filesystem::absolute(target.file()).parent_path().string();
  GltfFile gltf;
  std::string errors, warnings;
  bool parsed = false;
  try {
    parsed = loader.LoadASCIIFromString(&gltf.model, &errors, &warnings, json.data(),
                                        static_cast<unsigned>(json.size()), folder);
    json = {};
    if (parsed) gltf.buffers = find_buffers(buffers, folder, binary, place);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {  // tinygltf and its JSON throw on some values of the wrong type
    fail(place, "{}", short_line(error.what()));
  }
  // tinygltf skips primitives that it does not understand, but reports them.
  if (!parsed || !errors.empty()) fail(place, "{}", short_line(errors));
  if (const std::string& version = gltf.model.asset.version; !version.starts_with("2."))
    fail(place, "is glTF of version {}; only 2 is known", short_line(version));
  check_extensions(gltf.model, target);
  return gltf;
}

}  // namespace triptych
