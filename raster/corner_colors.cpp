#include "raster/corner_colors.hpp"

#include <glm/geometric.hpp>

namespace triptych {

InterpolatedColors interpolate_colors(const VertexStage& stage, int width, int height,
                                      const SlotTable::Triangle& shown, float lit) {
  const RasterChunk& chunk = *shown.range->chunk;
  InterpolatedColors result;
  glm::dvec3 corners[3];  // in pixels, times w
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t vertex = chunk.corner[i][shown.triangle];
    const auto clip = stage.to_clip<glm::dvec4>(shown.range->placed, chunk, vertex);
    corners[i] = {(clip.x + clip.w) * (0.5 * width), (clip.y + clip.w) * (0.5 * height), clip.w};
    for (size_t channel = 0; channel < 3; ++channel)
      result.corners[i][channel] = static_cast<float>(chunk.vertex_color[vertex][channel]) / 255.0f * lit;
  }
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 weight = glm::cross(corners[(i + 1) % 3], corners[(i + 2) % 3]);
    for (int k = 0; k < 3; ++k) result.weights[i][k] = weight[k];
  }
  return result;
}

void InterpolatedColors::at(int32_t x, int32_t y, float (&color)[3]) const {
  const double px = x + 0.5, py = y + 0.5;
  double own[3], sum = 0;
  for (int i = 0; i < 3; ++i) own[i] = (weights[i][0] * px + weights[i][1] * py) + weights[i][2];
  const double whole = (own[0] + own[1]) + own[2];
  for (double& weight : own) {
    // At an edge, or of a triangle seen from its edge, the pixel's centre may lie a little outside.
    weight /= whole;
    if (!(weight > 0)) weight = 0;
    if (weight > 1) weight = 1;
    sum += weight;
  }
  for (int channel = 0; channel < 3; ++channel) {
    const double mixed = (own[0] * static_cast<double>(corners[0][channel]) +
                          own[1] * static_cast<double>(corners[1][channel])) +
                         own[2] * static_cast<double>(corners[2][channel]);
    color[channel] = sum > 0 ? static_cast<float>(mixed / sum) : corners[0][channel];
  }
}

}  // namespace triptych
