// From the bytes of a .gltf or .glb file to its JSON and its binary chunk.
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

/// The content of a binary glTF file: its first chunk is JSON, the second one binary data; further chunks and
/// what stands behind the length that the header says are passed over.
Container open_binary(const std::shared_ptr<const StreamSource>& source, const SourceReader& reader,
                      const std::string& place, FileImport* target) {
  constexpr uint32_t json_kind = 0x4e4f534a, binary_kind = 0x004e4942;
  if (source->size() < 20) fail(place, "the file ends within its header of 20 bytes");
  if (word_at(reader, 4) != 2)
    fail(place, "is binary glTF of version {}; only 2 is known", word_at(reader, 4));
  const uint64_t promised = word_at(reader, 8);
  const uint64_t size = promised < 20 ? source->size() : std::min(promised, source->size());
  if (target && size != promised)
    target->remark(fmt::format("the header says {} bytes, the file holds {}", promised, source->size()));
  if (target) target->warn("bytes after the last chunk were skipped", source->size() - size);
  const uint64_t json_bytes = word_at(reader, 12);
  if (word_at(reader, 16) != json_kind) fail(place, "byte 16: the first chunk is not JSON");
  if (json_bytes == 0 || json_bytes > size - 20)
    fail(place, "byte 12: a chunk of {} bytes goes beyond the file", json_bytes);
  Container container{std::string(json_bytes, ' '), std::nullopt};
  reader.read(20, std::as_writable_bytes(std::span(container.json)));
  while (!container.json.empty() && container.json.back() == '\0') container.json.pop_back();
  for (uint64_t next = 20 + json_bytes; size - next >= 8;) {
    uint64_t bytes = word_at(reader, next);
    const bool is_binary = word_at(reader, next + 4) == binary_kind;
    constexpr uint64_t padding = 3;  // which some programs count, but do not write
    if (bytes > size - next - 8 && bytes - (size - next - 8) <= padding) bytes = size - next - 8;
    if (bytes > size - next - 8) {
      if (!is_binary) break;
      fail(place, "byte {}: a chunk of {} bytes goes beyond the file", next, bytes);
    }
    if (is_binary) {
      container.binary = GltfBuffer{source, next + 8, bytes};
      break;
    }
    if (target) target->warn("chunks of an unknown kind were skipped");
    next += 8 + bytes;
  }
  return container;
}

Container open_container(const std::shared_ptr<const StreamSource>& source, const std::string& place,
                         FileImport* target) {
  const SourceReader reader(source);
  std::string beginning(std::min<uint64_t>(4, source->size()), ' ');
  reader.read(0, std::as_writable_bytes(std::span(beginning)));
  if (beginning == "glTF") return open_binary(source, reader, place, target);
  if (source->size() > std::numeric_limits<uint32_t>::max()) fail(place, "is JSON of more than 4 GiB");
  Container container{std::string(source->size(), ' '), std::nullopt};
  reader.read(0, std::as_writable_bytes(std::span(container.json)));
  return container;
}

/// Extensions without which a file is drawn all the same: they add to what is there.
bool may_be_ignored(const std::string& name) {
  for (const char* known : {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_node_visibility",
                            "KHR_draco_mesh_compression", "EXT_meshopt_compression",
                            "KHR_meshopt_compression", "KHR_texture_transform", "EXT_texture_webp",
                            "KHR_texture_basisu", "KHR_materials_emissive_strength", "KHR_lights_punctual"}) {
    if (name == known) return true;
  }
  return false;
}

/// Whether anything in the file is compressed as the extension says.
bool is_used(const GltfDocument& gltf, const std::string& extension) {
  if (extension != "KHR_draco_mesh_compression")
    return std::any_of(gltf.views.begin(), gltf.views.end(),
                       [](const GltfView& view) { return view.meshopt; });
  return std::any_of(gltf.meshes.begin(), gltf.meshes.end(), [](const GltfMesh& mesh) {
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                       [](const GltfPrimitive& primitive) { return primitive.draco.has_value(); });
  });
}

void check_extensions(const GltfDocument& gltf, FileImport& target) {
  for (const std::string& name : gltf.required_extensions) {
    const std::string shown = one_line(name.substr(0, 80));
    if (name.ends_with("_compression") && may_be_ignored(name)) {
      // Some tool dropped the extension's objects: what is left would be read as geometry, and is noise.
      if (!is_used(gltf, name))
        fail(target.place(), "requires {}, but says of nothing how it is compressed; export it again", shown);
    } else if (!may_be_ignored(name)) {
      target.warn(
          fmt::format("extension is required that is not known, what it adds is not drawn: {}", shown));
    }
  }
}

}  // namespace

std::vector<std::filesystem::path> files_beside_gltf(const std::filesystem::path& file) {
  const auto container = open_container(std::make_shared<StreamSource>(file), file.string(), nullptr);
  std::vector<std::filesystem::path> files;
  for (const std::string& name : names_in_gltf(container.json, file.string()))
    files.push_back(file.parent_path() / name);
  return files;
}

GltfFile load_gltf(FileImport& target, const std::shared_ptr<const StreamSource>& source) {
  const std::string place = target.place();
  auto [json, binary] = open_container(source, place, &target);
  const auto [buffers, images] = take_buffers(json, place);
  GltfFile gltf;
  gltf.options = target.options();
  auto document = parse_gltf(json, place);
  json = {};
  auto found = document ? find_buffers(buffers, target, binary) : std::nullopt;
  // What is wrong is said of the whole text, with what was taken out of it.
  if (!found) fail(place, "{}", gltf_fault(open_container(source, place, nullptr).json));
  gltf.model = std::move(*document);
  gltf.buffers = std::move(*found);
  gltf.images = find_gltf_images(images);
  if (const std::string& version = gltf.model.version; !version.starts_with("2"))
    fail(place, "is glTF of version {}; only 2 is known", one_line(version.substr(0, 20)));
  check_extensions(gltf.model, target);
  constexpr size_t most = 8;
  size_t kinds = 0;
  for (const auto& [member, count] : gltf.model.misread)
    target.warn(++kinds > most ? "further members of the file are of a wrong type and were skipped"
                               : fmt::format("members \"{}\" are of a wrong type and were skipped",
                                             one_line(member.substr(0, 40))),
                count);
  return gltf;
}

}  // namespace triptych
