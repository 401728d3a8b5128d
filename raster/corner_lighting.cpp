#include "raster/corner_lighting.hpp"

#include "raster/chunk_geometry.hpp"
#include "scene/vertex_light.hpp"
#include "visibility/shading.hpp"

#include <cmath>

namespace triptych {

LightParts parts_of_light(const glm::vec3& normal, const glm::vec3& light) {
  const float towards = (normal.x * light.x + normal.y * light.y) + normal.z * light.z;
  return {diffuse_light * std::abs(towards), ambient_light + head_light * std::abs(normal.z)};
}

CornerLighting corner_lighting(const SlotTable::Triangle& shown) {
  const RasterChunk& chunk = *shown.range->chunk;
  CornerLighting result;
  for (size_t i = 0; i < 3; ++i) {
    const VertexLight& own = chunk.light[chunk.corner[i][shown.triangle]];
    for (size_t k = 0; k < 3; ++k) result.irradiance[i][k] = irradiance_of(own[k]);
    result.openness[i] = openness_of(own[3]);
  }
  return result;
}

CornerLighting::At CornerLighting::at(const PerspectiveWeights& weights, int32_t x, int32_t y) const {
  double own[3];
  const double sum = weights.clamped_at(x + 0.5, y + 0.5, own);
  const auto mixed = [&](float a, float b, float c) {
    const double whole =
        (own[0] * static_cast<double>(a) + own[1] * static_cast<double>(b)) + own[2] * static_cast<double>(c);
    return sum > 0 ? static_cast<float>(whole / sum) : a;
  };
  At at;
  for (size_t k = 0; k < 3; ++k)
    at.irradiance[k] = mixed(irradiance[0][k], irradiance[1][k], irradiance[2][k]);
  at.openness = mixed(openness[0], openness[1], openness[2]);
  return at;
}

}  // namespace triptych
