// A whole model at full detail as one list of triangles: what a program would draw, or trace rays against,
// that has neither a hierarchy nor levels of detail.
#pragma once

#include "scene/hidden_objects.hpp"
#include "scene/pack.hpp"
#include "scene/poses.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace triptych {

/// 16 bytes, as graphics cards and ray tracers read it.
struct FlatVertex {
  glm::vec3 position;            ///< model position = FlatModel::origin + FlatModel::unit · position
  std::array<uint8_t, 4> color;  ///< sRGB bytes; a triangle shows its last corner's, also of vertex colours
};
static_assert(sizeof(FlatVertex) == 16);

struct FlatModel {
  glm::dvec3 origin{0};  ///< the middle of the model
  double unit = 1;       ///< model units: a power of two near the model's size
  std::vector<FlatVertex> vertices;
  std::vector<uint32_t> indices;  ///< three a triangle

  size_t triangle_count() const { return indices.size() / 3; }
};

/// What flatten() gives, known from the skeleton alone.
struct FlatModelSize {
  uint64_t vertices = 0, triangles = 0;
  uint64_t bytes() const { return vertices * sizeof(FlatVertex) + triangles * 3 * sizeof(uint32_t); }
};
FlatModelSize flat_model_size(const Skeleton& skeleton, const HiddenObjects* hidden = nullptr);

/// Every leaf's finest drawable, each placement that is not hidden transformed; on all cores. hidden: of this
/// pack; null where nothing is. poses: where what moves is; null: where it is at time 0. Error (pack, chunk)
/// for damage, and (pack) for more vertices than 32 bits can name.
FlatModel flatten(const Pack& pack, const HiddenObjects* hidden = nullptr, const Poses* poses = nullptr);

}  // namespace triptych
