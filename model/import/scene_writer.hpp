// Writes a scene stream (scene_stream.hpp) to an open file.
#pragma once

#include "model/import/scene_stream.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// Each call writes a record, and those that others can name return its number. Buffered: complete after
/// end(). Error (place) where the file cannot be written.
class SceneWriter {
 public:
  /// defined: unit_is_defined | axes_are_defined
  SceneWriter(int descriptor, std::string place, uint32_t defined);

  uint32_t material(const glm::vec4& display_color);
  /// Indices: three a triangle; the parts' triangles one after the other.
  uint32_t mesh(std::string_view name, std::span<const glm::dvec3> positions,
                std::span<const uint32_t> indices, std::span<const ScenePart> parts);
  uint32_t property_set(const ScenePropertySet& set);
  uint32_t object(const SceneObject& object);
  void instance(const SceneInstance& instance);
  void end();

  uint32_t instances() const { return instances_; }

 private:
  void begin(SceneRecord kind, uint64_t bytes);
  void texts(SceneRecord kind, std::span<const std::string_view> texts, std::span<const uint32_t> numbers);
  template <typename Value>
  void write(const Value& value) {
    write_bytes(std::as_bytes(std::span(&value, 1)));
  }
  void write_bytes(std::span<const std::byte> bytes);
  void flush();

  int descriptor_;
  std::string place_;
  std::vector<std::byte> buffer_;
  uint32_t materials_ = 0, meshes_ = 0, property_sets_ = 0, objects_ = 0, instances_ = 0;
};

}  // namespace triptych
