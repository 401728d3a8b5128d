#include "model/import/scene_writer.hpp"

#include "base/descriptor.hpp"

namespace triptych {

namespace {
constexpr size_t buffer_bytes = size_t{1} << 20;
}

SceneWriter::SceneWriter(int descriptor, std::string place, uint32_t defined)
    : descriptor_(descriptor), place_(std::move(place)) {
  write(scene_stream_magic);
  write(scene_stream_version);
  write(defined);
}

uint32_t SceneWriter::material(const glm::vec4& display_color) {
  begin(SceneRecord::material, 16);
  write(display_color);
  return materials_++;
}

uint32_t SceneWriter::mesh(std::string_view name, std::span<const glm::dvec3> positions,
                           std::span<const uint32_t> indices, std::span<const ScenePart> parts) {
  begin(SceneRecord::mesh,
        16 + parts.size_bytes() + name.size() + positions.size_bytes() + indices.size_bytes());
  write(static_cast<uint32_t>(name.size()));
  write(uint32_t{8});
  write(static_cast<uint32_t>(positions.size()));
  write(static_cast<uint32_t>(parts.size()));
  write_bytes(std::as_bytes(parts));
  write_bytes(std::as_bytes(std::span(name)));
  write_bytes(std::as_bytes(positions));
  write_bytes(std::as_bytes(indices));
  return meshes_++;
}

uint32_t SceneWriter::property_set(const ScenePropertySet& set) {
  std::vector<std::string_view> words = {set.name};
  for (const auto& [name, value] : set.properties) words.insert(words.end(), {name, value});
  texts(SceneRecord::property_set, words, {});
  return property_sets_++;
}

uint32_t SceneWriter::object(const SceneObject& object) {
  const std::array<std::string_view, 6> words = {object.id,   object.name,   object.guid,
                                                 object.type, object.storey, object.layer};
  texts(SceneRecord::object, words, object.property_sets);
  return objects_++;
}

void SceneWriter::instance(const SceneInstance& instance) {
  begin(SceneRecord::instance, 12 + sizeof(Affine));
  write(instance.mesh);
  write(instance.material);
  write(instance.object);
  write(instance.transform);
  ++instances_;
}

void SceneWriter::end() {
  begin(SceneRecord::end, 20);
  for (const uint32_t count : {materials_, meshes_, property_sets_, objects_, instances_}) write(count);
  flush();
}

void SceneWriter::begin(SceneRecord kind, uint64_t bytes) {
  write(kind);
  write(bytes);
}

void SceneWriter::texts(SceneRecord kind, std::span<const std::string_view> texts,
                        std::span<const uint32_t> numbers) {
  uint64_t bytes = 8 + numbers.size_bytes();
  for (const std::string_view text : texts) bytes += 4 + text.size();
  begin(kind, bytes);
  write(static_cast<uint32_t>(texts.size()));
  write(static_cast<uint32_t>(numbers.size()));
  for (const std::string_view text : texts) {
    write(static_cast<uint32_t>(text.size()));
    write_bytes(std::as_bytes(std::span(text)));
  }
  write_bytes(std::as_bytes(numbers));
}

// Not inlined: g++ 12 sees overflows in vectors that grow where there are none.
[[gnu::noinline]] void SceneWriter::write_bytes(std::span<const std::byte> bytes) {
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  if (buffer_.size() >= buffer_bytes) flush();
}

void SceneWriter::flush() {
  write_all(descriptor_, buffer_, place_);
  buffer_.clear();
}

}  // namespace triptych
