// Collects the vertices and faces of a file that cannot be streamed into meshes.
#pragma once

#include "model/import/byte_spool.hpp"
#include "model/import/import_file.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// Takes vertices and faces in any order, and places the meshes in the end: in memory where they are few, at
/// most 262,144 triangles and vertices and what is left of ImportOptions::max_in_memory, otherwise as
/// streams of a temporary file.
class MeshSpool {
 public:
  explicit MeshSpool(FileImport& target) : target_(target) {}

  /// color: as displayed, 0 to 1; nothing if the vertex has none. normal: of any length; 0 if it has none.
  void add_vertex(const glm::dvec3& position, const std::optional<glm::dvec3>& color = std::nullopt,
                  const glm::dvec3& normal = glm::dvec3(0));
  uint64_t vertex_count() const { return vertices_.size() / sizeof(glm::dvec3); }
  /// The faces that follow belong to a mesh of this name; a mesh without faces is dropped. It is no object.
  void begin_mesh(std::string name);
  /// The same, and they belong to an object of this name: `begin_group` to one within the object before, the
  /// same one where the name comes again.
  void begin_object(std::string name);
  void begin_group(std::string name);
  /// Faces have colours of their own, and vertices none: said before the first of either.
  void color_faces() { faces_have_colors_ = true; }
  /// Corners of faces may have normals of their own, and vertices have none: said before the first of either.
  void shade_faces() { faces_have_normals_ = true; }
  /// Corners of faces may have places on textures: said before the first face.
  void place_faces() { faces_have_places_ = true; }
  bool has_faces() const { return faces_.size() > 0; }
  /// The corners' vertices may be added later. Fewer than three corners are skipped and counted. normals,
  /// places on the texture: of the corners, or empty.
  void add_face(std::span<const uint32_t> corners, uint32_t material, const VertexColor& color = {},
                std::span<const VertexNormal> normals = {}, std::span<const TextureCoordinates> places = {});
  /// What colours of vertices are multiplied by to be from 0 to 1; said before finish().
  void scale_colors(double scale) { color_scale_ = scale; }
  /// Places the meshes. Every vertex that a face names must have been added.
  void finish();

 private:
  struct Part {
    std::string name;
    uint64_t begin = 0;  ///< byte of the first face
    uint64_t faces = 0, end = 0;
    uint32_t object = no_id, group = no_id;  ///< of names_, the group within the object
  };
  struct Name {
    std::string name;
    uint32_t within = no_id;  ///< of names_
    SourceObjectId id = no_id;
  };
  /// Continues in a file if there is this much.
  void grow_beyond(uint64_t triangles_or_vertices);
  void add_color(const std::optional<glm::dvec3>& color);
  void add_normal(const glm::dvec3& normal);
  /// The object of what names_ has there, added when it is used first.
  SourceObjectId object_of(uint32_t name);
  SourceObjectId object_of(const Part& part) {
    return object_of(part.group == no_id ? part.object : part.group);
  }
  /// A face as it is kept; normals, places: of its corners, or empty.
  struct Face {
    uint32_t material = 0;
    VertexColor color{};
    std::vector<VertexNormal> normals;
    std::vector<TextureCoordinates> places;
    std::vector<uint32_t> corners;
  };
  /// Takes the next face of a part off its bytes.
  void take_face(std::span<const std::byte>& bytes, Face& face) const;
  void place_in_memory();
  void place_streams();

  FileImport& target_;
  ByteSpool vertices_;  ///< three doubles each
  ByteSpool colors_;    ///< three floats for each vertex, no numbers for none; empty while none has one
  ByteSpool normals_;   ///< three floats for each vertex, 0 for none; empty while none has one
  /// Material; the face's colour, if faces have some; number of normals and normals, if faces have some;
  /// number of places and places, if faces have some, in 64 bits; number of corners and corners: 32 bits
  /// each.
  ByteSpool faces_;
  std::vector<Part> parts_;
  std::vector<Name> names_;
  std::map<std::pair<uint32_t, std::string>, uint32_t> groups_;  ///< by the object that they are within
  uint32_t object_ = no_id;                                      ///< of names_: the last one that began
  uint64_t triangles_ = 0;
  bool in_file_ = false, faces_have_colors_ = false, faces_have_normals_ = false, faces_have_places_ = false;
  double color_scale_ = 1;
};

}  // namespace triptych
