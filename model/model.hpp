// A model as the user gives it: meshes, instances of them, materials, names and properties. Positions and
// transforms are in double.
#pragma once

#include "model/mesh_stream.hpp"
#include "scene/affine.hpp"
#include "scene/geo_place.hpp"
#include "scene/import_report.hpp"
#include "scene/motion.hpp"
#include "scene/source_objects.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// An image that materials name.
struct ModelImage {
  std::string place;  ///< of errors: the file, and which of its images
  /// Its bytes, as the file holds them; Error if they are gone. Empty where there is only an alpha: white.
  std::function<std::vector<std::byte>()> read;
  /// Another image that says its alpha: by its own or, where that is 1 all over, by its brightness. Null: the
  /// image says it itself.
  std::shared_ptr<const ModelImage> alpha = nullptr;
};

/// Linear factors are as the file gives them.
struct Material {
  /// Linear factor as the file gives it, red, green, blue, alpha in 0..1.
  glm::vec4 base_color{0.8f, 0.8f, 0.8f, 1};
  uint32_t texture = no_id;           ///< index into the model's images: multiplies the base colour
  uint32_t emission_texture = no_id;  ///< multiplies the emission, at the same coordinates
  TextureSampler sampler = {};
  glm::vec3 emission{0};  ///< light of its own, a linear factor
  glm::vec3 emitted{0};   ///< that it gives others, where that is more than it shows; 0: as much
  float cutoff = 0;       ///< where the texture's alpha is less, there is a hole; 0: nowhere
  bool blends = false;    ///< the texture's alpha lets through what lies behind
  bool operator==(const Material&) const = default;
};

/// A light that is a point, or so far away that its rays are parallel (KHR_lights_punctual of glTF).
struct ModelLight {
  enum class Kind : uint8_t { point, spot, directional };
  Kind kind = Kind::point;
  glm::dvec3 position{0};          ///< model space; unused if directional
  glm::dvec3 direction{0, 0, -1};  ///< of its rays, model space, unit length; unused of a point
  /// Linear red, green, blue: luminous intensity in candela, of a directional one illuminance in lux.
  glm::dvec3 intensity{0};
  double inner_cosine = 1, outer_cosine = 0;  ///< of a spot's cone: full light within, none beyond
  double range = 0;                           ///< model units; 0: no end
};

/// A triangle of a mesh: three vertex indices and the index of its material.
struct Triangle {
  std::array<uint32_t, 3> vertices;
  uint32_t material;
  bool operator==(const Triangle&) const = default;
};

/// Triangles in mesh space; of any kind: soups, non-manifold, degenerate. Coordinates are finite, indices
/// in range. The geometry is in memory (positions and triangles), or in its file (stream, and both empty).
struct Mesh {
  std::string name;
  std::vector<glm::dvec3> positions;
  std::vector<Triangle> triangles;
  std::shared_ptr<const MeshStream> stream = nullptr;  ///< null: in memory
  /// Of each position, where the file has any; empty otherwise. They multiply the base colour of the material
  /// in linear light, but for material 0, which stands for none.
  std::vector<VertexColor> colors = {};
  /// The shading normal of each position, mesh space, where the file has any; empty otherwise.
  std::vector<VertexNormal> normals = {};
  /// Of each position its place on the texture of the material, where any has one; empty otherwise.
  std::vector<TextureCoordinates> coordinates = {};
  /// Baked light of each position; empty unless the build made it (light/).
  std::vector<VertexLight> light = {};

  /// Of a stream: as MeshStream::triangle_count.
  uint64_t triangle_count() const;
  bool has_colors() const;       ///< of vertices
  bool has_normals() const;      ///< the same
  bool has_coordinates() const;  ///< the same
};

/// One placement of a mesh in the model.
struct Instance {
  Instance() = default;
  Instance(uint32_t of_mesh, const Affine& placed, SourceObjectId of_object = no_id)
      : mesh(of_mesh), object(of_object), transform(placed) {}

  uint32_t mesh = 0;
  /// Index into SourceObjects::objects; in a group counted from GroupInstance::first_object. no_id: of none.
  SourceObjectId object = no_id;
  Affine transform{1};
};

/// One placement of a group, in the model or in another group.
struct GroupInstance {
  GroupInstance() = default;
  GroupInstance(uint32_t of_group, const Affine& placed, SourceObjectId first = no_id)
      : group(of_group), first_object(first), transform(placed) {}

  uint32_t group = 0;
  /// What the objects of all that is in the group count from, in another group again from what that one
  /// counts from: each placement has its own. no_id: what is in it belongs to none.
  SourceObjectId first_object = no_id;
  Affine transform{1};  ///< the group's space to that of what it is placed in
  /// Index into Motion::joints, in the model alone: what takes the group's space to the model's at all times;
  /// the transform is that at time 0. no_id: it does not move.
  uint32_t joint = no_id;
};

/// Placements that repeat together, in a space of their own.
struct Group {
  std::vector<Instance> instances;
  std::vector<GroupInstance> groups;  ///< only of groups before this one
};

struct Model {
  std::vector<Mesh> meshes;
  std::vector<Material> materials;  ///< at least one
  std::vector<ModelImage> images;
  std::vector<ModelLight> lights;
  std::vector<Instance> instances;  ///< those that belong to no group
  /// What repeats, stored once; empty for most models, which are lists of instances. See model/flatten.hpp.
  std::vector<Group> groups;
  std::vector<GroupInstance> group_instances;
  Motion motion;  ///< of group instances
  /// Where on Earth it stands, where a file says so, or the build is told.
  std::optional<GeoPlace> geo_place = std::nullopt;
  SourceObjects source_objects;  ///< empty for models without names
  /// What was or will be read: the model files, and the buffers and material libraries that they name. What
  /// triptych-import opened beside a file is among them.
  std::vector<std::filesystem::path> files;
  ImportReport report;

  std::string name() const;           ///< of its first file, for errors
  uint64_t source_triangles() const;  ///< unique: each mesh once
  uint64_t placed_triangles() const;  ///< each mesh as often as it is placed, in groups too
};

}  // namespace triptych
