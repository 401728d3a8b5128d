#include "raster/corner_colors.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace triptych {

InterpolatedColors interpolate_colors(const VertexStage& stage, int width, int height,
                                      const SlotTable::Triangle& shown, const CornerBase& base, float lit,
                                      const CornerLights* lights) {
  const RasterChunk& chunk = *shown.range->chunk;
  InterpolatedColors result;
  result.lit = lit;
  result.bends = lights != nullptr;
  if (lights) std::copy(std::begin(lights->eye), std::end(lights->eye), result.normals);
  glm::dvec3 corners[3];  // in pixels, times w
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t vertex = chunk.corner[i][shown.triangle];
    const auto clip = stage.to_clip<glm::dvec4>(shown.range->placed, chunk, vertex);
    corners[i] = {(clip.x + clip.w) * (0.5 * width), (clip.y + clip.w) * (0.5 * height), clip.w};
    for (size_t channel = 0; channel < 3; ++channel) {
      const float own = base.vertex_colors ? static_cast<float>(chunk.vertex_color[vertex][channel]) / 255.0f
                                           : base.material[static_cast<int>(channel)];
      result.corners[i][channel] = own * lit;
    }
  }
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 weight = glm::cross(corners[(i + 1) % 3], corners[(i + 2) % 3]);
    for (int k = 0; k < 3; ++k) result.weights[i][k] = weight[k];
  }
  return result;
}

double InterpolatedColors::weights_at(int32_t x, int32_t y, double (&own)[3]) const {
  const double px = x + 0.5, py = y + 0.5;
  double sum = 0;
  for (int i = 0; i < 3; ++i) own[i] = (weights[i][0] * px + weights[i][1] * py) + weights[i][2];
  const double whole = (own[0] + own[1]) + own[2];
  for (double& weight : own) {
    // At an edge, or of a triangle seen from its edge, the pixel's centre may lie a little outside.
    weight /= whole;
    if (!(weight > 0)) weight = 0;
    if (weight > 1) weight = 1;
    sum += weight;
  }
  return sum;
}

void InterpolatedColors::color_at(const double (&own)[3], double sum, float (&color)[3]) const {
  for (int channel = 0; channel < 3; ++channel) {
    const double mixed = (own[0] * static_cast<double>(corners[0][channel]) +
                          own[1] * static_cast<double>(corners[1][channel])) +
                         own[2] * static_cast<double>(corners[2][channel]);
    color[channel] = sum > 0 ? static_cast<float>(mixed / sum) : corners[0][channel];
  }
}

void InterpolatedColors::at(int32_t x, int32_t y, const glm::vec3& light, float (&color)[3]) const {
  double own[3];
  const double sum = weights_at(x, y, own);
  color_at(own, sum, color);
  if (!bends) return;
  const float w[3] = {static_cast<float>(own[0]), static_cast<float>(own[1]), static_cast<float>(own[2])};
  const glm::vec3 normal = (normals[0] * w[0] + normals[1] * w[1]) + normals[2] * w[2];
  const float own_light = light_on(unit_or_zero(sum > 0 ? normal : normals[0]), light);
  for (float& channel : color) channel *= own_light;
}

void InterpolatedColors::base_at(int32_t x, int32_t y, float (&color)[3]) const {
  double own[3];
  color_at(own, weights_at(x, y, own), color);
  for (float& channel : color) channel /= lit;
}

}  // namespace triptych
