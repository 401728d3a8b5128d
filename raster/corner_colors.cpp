#include "raster/corner_colors.hpp"

#include <algorithm>

namespace triptych {

InterpolatedColors interpolate_colors(const VertexStage& stage, int width, int height,
                                      const SlotTable::Triangle& shown, const CornerBase& base, float lit,
                                      const CornerLights* lights) {
  const RasterChunk& chunk = *shown.range->chunk;
  InterpolatedColors result;
  result.lit = lit;
  result.bends = lights != nullptr;
  if (lights) std::copy(std::begin(lights->eye), std::end(lights->eye), result.normals);
  result.weights = perspective_weights(stage, width, height, shown.range->placed, chunk, shown.triangle);
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t vertex = chunk.corner[i][shown.triangle];
    for (size_t channel = 0; channel < 3; ++channel) {
      const float own = base.vertex_colors ? static_cast<float>(chunk.vertex_color[vertex][channel]) / 255.0f
                                           : base.material[static_cast<int>(channel)];
      result.corners[i][channel] = own * lit;
    }
  }
  return result;
}

void InterpolatedColors::color_at(const double (&own)[3], double sum, float (&color)[3]) const {
  for (int channel = 0; channel < 3; ++channel) {
    const double mixed = (own[0] * static_cast<double>(corners[0][channel]) +
                          own[1] * static_cast<double>(corners[1][channel])) +
                         own[2] * static_cast<double>(corners[2][channel]);
    color[channel] = sum > 0 ? static_cast<float>(mixed / sum) : corners[0][channel];
  }
}

float InterpolatedColors::at(int32_t x, int32_t y, const glm::vec3& light, float (&color)[3]) const {
  double own[3];
  const double sum = weights.clamped_at(x + 0.5, y + 0.5, own);
  color_at(own, sum, color);
  if (!bends) return 1;
  return light_on(normal_by(own, sum), light);
}

glm::vec3 InterpolatedColors::normal_by(const double (&own)[3], double sum) const {
  const float w[3] = {static_cast<float>(own[0]), static_cast<float>(own[1]), static_cast<float>(own[2])};
  const glm::vec3 normal = (normals[0] * w[0] + normals[1] * w[1]) + normals[2] * w[2];
  return unit_or_zero(sum > 0 ? normal : normals[0]);
}

glm::vec3 InterpolatedColors::normal_at(int32_t x, int32_t y) const {
  double own[3];
  const double sum = weights.clamped_at(x + 0.5, y + 0.5, own);
  return normal_by(own, sum);
}

void InterpolatedColors::base_at(int32_t x, int32_t y, float (&color)[3]) const {
  double own[3];
  const double sum = weights.clamped_at(x + 0.5, y + 0.5, own);
  color_at(own, sum, color);
  for (float& channel : color) channel /= lit;
}

}  // namespace triptych
