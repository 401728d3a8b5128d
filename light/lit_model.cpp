#include "light/lit_model.hpp"

#include "base/error.hpp"
#include "model/read_mesh.hpp"
#include "scene/box.hpp"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <tsl/robin_map.h>

namespace triptych {

namespace {

struct PlaceHash {
  size_t operator()(const glm::dvec3& p) const {
    uint64_t hash = 0;
    for (int k = 0; k < 3; ++k)
      hash = (hash ^ std::bit_cast<uint64_t>(p[k])) * 0x9e3779b97f4a7c15u ^ (hash >> 29);
    return static_cast<size_t>(hash ^ (hash >> 32));
  }
};

/// Numbers places as they come.
class Places {
 public:
  explicit Places(std::vector<glm::dvec3>& places) : places_(places) {}
  uint32_t number(const glm::dvec3& given) {
    const glm::dvec3 place = given + 0.0;  // no negative zeros
    const auto [found, inserted] = numbers_.try_emplace(place, static_cast<uint32_t>(places_.size()));
    if (inserted) places_.push_back(place);
    return found->second;
  }

 private:
  std::vector<glm::dvec3>& places_;
  tsl::robin_map<glm::dvec3, uint32_t, PlaceHash> numbers_;
};

/// What takes normals along: cofactors, so that they stay on their side of mirrored surfaces.
glm::dmat3 cofactors_of(const glm::dmat3& m) {
  const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::determinant(m) < 0 ? -cofactors : cofactors;
}

constexpr uint64_t bytes_a_triangle = sizeof(LitTriangle) + 3 * (sizeof(glm::dvec3) + 32);

}  // namespace

glm::dvec3 LitModel::normal(const LitTriangle& triangle) const {
  const glm::dvec3& a = at(triangle.corners[0]);
  return glm::cross(at(triangle.corners[1]) - a, at(triangle.corners[2]) - a);
}

uint64_t lit_model_bytes(const Model& model) { return model.placed_triangles() * bytes_a_triangle; }

LitModel place_all(const Model& model, uint64_t memory) {
  if (const uint64_t needed = lit_model_bytes(model); needed > memory)
    fail(model.name(),
         "has {} placed triangles, for whose light {} MiB are needed and {} MiB are left: give more "
         "--memory, or build "
         "without --bake-light and --ambient",
         model.placed_triangles(), needed >> 20, memory >> 20);
  LitModel lit;
  lit.triangles.reserve(model.placed_triangles());
  Places places(lit.places);
  Box box;
  for (uint32_t i = 0; i < model.instances.size(); ++i) {
    const Instance& instance = model.instances[i];
    const glm::dmat3 linear(instance.transform);
    const glm::dmat3 of_normals = cofactors_of(linear);
    const bool mirrors = glm::determinant(linear) < 0;
    const auto add = [&](std::span<const CornerTriangle> batch) {
      for (const CornerTriangle& triangle : batch) {
        LitTriangle& added = lit.triangles.emplace_back();
        added.material = triangle.material;
        added.instance = i;
        for (size_t k = 0; k < 3; ++k) {
          const size_t from = mirrors && k > 0 ? 3 - k : k;
          const glm::dvec3 placed = instance.transform * glm::dvec4(triangle.corners[from], 1);
          box.extend(placed);
          VertexNormal normal = {};
          if (has_normal(triangle.normals[from]))
            normal = to_vertex_normal(of_normals * direction_of(triangle.normals[from]));
          added.corners[k] = {places.number(placed), 0, triangle.colors[from], normal,
                              triangle.coordinates[from]};
        }
      }
    };
    const Mesh& mesh = model.meshes[instance.mesh];
    if (const auto loaded = mesh.stream ? mesh.stream->load() : nullptr) {
      read_mesh(*loaded, add);
    } else {
      read_mesh(mesh, add);
    }
  }
  if (!lit.triangles.empty()) lit.diagonal = glm::distance(box.lo, box.hi);
  return lit;
}

Model with_light(Model model, const LitModel& lit, const std::vector<VertexLight>& light) {
  Model result = std::move(model);
  const std::vector<Mesh> sources = std::move(result.meshes);
  result.meshes.clear();
  using Key = std::array<uint32_t, 6>;
  size_t first = 0;
  for (uint32_t i = 0; i < result.instances.size(); ++i) {
    Instance& instance = result.instances[i];
    const Mesh& source = sources[instance.mesh];
    Mesh mesh;
    mesh.name = source.name;
    const bool colored = source.has_colors(), shaded = source.has_normals(),
               textured = source.has_coordinates();
    std::map<Key, uint32_t> vertices;
    for (; first < lit.triangles.size() && lit.triangles[first].instance == i; ++first) {
      const LitTriangle& triangle = lit.triangles[first];
      Triangle& added = mesh.triangles.emplace_back();
      added.material = triangle.material;
      for (size_t k = 0; k < 3; ++k) {
        const LitCorner& corner = triangle.corners[k];
        const Key key{corner.place,
                      corner.point,
                      std::bit_cast<uint32_t>(corner.color),
                      std::bit_cast<uint32_t>(corner.normal),
                      static_cast<uint32_t>(corner.coordinates.u),
                      static_cast<uint32_t>(corner.coordinates.v)};
        const auto [found, inserted] =
            vertices.try_emplace(key, static_cast<uint32_t>(mesh.positions.size()));
        if (inserted) {
          mesh.positions.push_back(lit.at(corner));
          mesh.light.push_back(light[corner.point]);
          if (colored) mesh.colors.push_back(corner.color);
          if (shaded) mesh.normals.push_back(corner.normal);
          if (textured) mesh.coordinates.push_back(corner.coordinates);
        }
        added.vertices[k] = found->second;
      }
    }
    instance.mesh = static_cast<uint32_t>(result.meshes.size());
    instance.transform = Affine(1);
    result.meshes.push_back(std::move(mesh));
  }
  return result;
}

}  // namespace triptych
