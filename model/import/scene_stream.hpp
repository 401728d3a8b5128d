// The scene stream: what the programs that read further formats write, and import_scene() reads. Its layout
// is in docs/formats.md. Everything is little-endian; coordinates are in double or single precision,
// transforms in double.
#pragma once

#include "model/import/mesh_stream_source.hpp"
#include "scene/affine.hpp"
#include "scene/geo_place.hpp"

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace triptych {

inline constexpr std::array<char, 8> scene_stream_magic = {'T', 'R', 'I', 'S', 'C', 'E', 'N', 'E'};
inline constexpr uint32_t scene_stream_version = 1;

/// What the header says of the file: bits.
inline constexpr uint32_t unit_is_defined = 1, axes_are_defined = 2;

enum class SceneRecord : uint32_t { material = 1, mesh, property_set, object, instance, end, geo_place };

/// Where a record could name another and does not.
inline constexpr uint32_t no_record = 0xffffffff;

/// A run of a mesh's triangles, and what they are made of; no_record: what the instance is made of.
struct ScenePart {
  uint32_t triangles = 0;
  uint32_t material = no_record;
};

/// A mesh in its stream: three coordinates a vertex, then three vertex numbers of 32 bits a triangle.
struct SceneMesh {
  std::string name;
  uint32_t coordinate_bytes = 4;  ///< 4 or 8
  uint32_t vertex_count = 0;
  std::vector<ScenePart> parts;
  uint64_t positions_at = 0, indices_at = 0;  ///< bytes of the stream

  uint64_t triangle_count() const;
};

/// Texts in UTF-8, empty where the file has none.
struct ScenePropertySet {
  std::string name;
  std::vector<std::pair<std::string, std::string>> properties;
};

struct SceneObject {
  std::string id;  ///< as the file numbers it: "#123"
  std::string name, guid, type, storey, layer;
  std::vector<uint32_t> property_sets;
};

struct SceneInstance {
  uint32_t mesh = 0, material = no_record, object = no_record;
  Affine transform{1};
};

/// Takes the records of a stream, in their order; what it has no use for, it leaves out. A record only names
/// others that came before it.
class SceneSink {
 public:
  virtual ~SceneSink() = default;
  /// Whether the file names its unit, and instances are in metres, otherwise in that unit; whether its format
  /// defines the axes, and instances are y up, otherwise in the file's axes.
  virtual void begin(bool /*unit_is_defined*/, bool /*axes_are_defined*/) {}
  /// Red, green, blue and alpha as displayed (sRGB), 0..1.
  virtual void material(const glm::vec4& /*display_color*/) {}
  virtual void mesh(SceneMesh /*mesh*/) {}
  virtual void property_set(ScenePropertySet /*set*/) {}
  virtual void object(SceneObject /*object*/) {}
  virtual void instance(const SceneInstance& /*instance*/) {}
  /// north: x and z of the axes of instances, which are y up.
  virtual void geo_place(const GeoPlace& /*geo_place*/) {}
};

/// Reads a whole stream but for positions and vertex numbers. Error (name, byte) for one that is damaged or
/// has no end.
void read_scene_stream(const std::shared_ptr<const StreamSource>& source, SceneSink& sink);

}  // namespace triptych
