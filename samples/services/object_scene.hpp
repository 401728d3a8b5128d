// Placed objects of shared meshes on their way into the scene's file, what they add up to, and where they
// stand in the way.
#pragma once

#include "samples/gltf_writer.hpp"
#include "samples/mesh_part.hpp"
#include "samples/rect.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace triptych {

using MeshParts = std::vector<MeshPart>;
using MakeMesh = std::function<MeshParts()>;

/// Whether people cannot walk through an object's box where it is between knee and head.
enum class Footprint { box, none };

/// Meshes are written when they are first placed; none is kept.
class ObjectScene {
 public:
  ObjectScene(GltfWriter& gltf, int storeys);

  /// An object of its own, at the scene's top. Objects that name the same mesh share it.
  void place(int storey, const std::string& place, const std::string& mesh, const MakeMesh& make,
             const glm::dmat4& transform, Footprint footprint);
  /// People cannot walk here, whatever the boxes say.
  void block(int storey, const Rect& rect) { obstacles_[static_cast<size_t>(storey)].push_back(rect); }

  const std::vector<Rect>& obstacles(int storey) const { return obstacles_[static_cast<size_t>(storey)]; }
  /// Of each object, in the order of placing.
  const std::vector<uint64_t>& triangles_of_objects() const { return triangles_; }
  /// Of each mesh.
  std::vector<uint64_t> uses_of_meshes() const;
  uint64_t unique_triangles() const;

 private:
  struct Written {
    size_t number = 0;
    uint64_t triangles = 0, uses = 0;
    glm::dvec3 low{0}, high{0};
  };
  Written& written(const std::string& mesh, const MakeMesh& make);

  GltfWriter& gltf_;
  std::map<std::string, Written> meshes_;
  std::vector<uint64_t> triangles_;
  std::vector<std::vector<Rect>> obstacles_;  // by storey
};

/// Places the objects of one room, corridor or shaft; heights count from its storey's floor.
struct Placer {
  ObjectScene& scene;
  int storey = 0;
  std::string place;

  void put(const std::string& mesh, const MakeMesh& make, const glm::dmat4& transform,
           Footprint footprint = Footprint::box) const;
};

}  // namespace triptych
