#include "raster/corner_colors.hpp"

namespace triptych {

InterpolatedColors interpolate_colors(const VertexStage& stage, int width, int height,
                                      const SlotTable::Triangle& shown, float lit) {
  const RasterChunk& chunk = *shown.range->chunk;
  InterpolatedColors result;
  result.weights = perspective_weights(stage, width, height, shown.range->placed, chunk, shown.triangle);
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t vertex = chunk.corner[i][shown.triangle];
    for (size_t channel = 0; channel < 3; ++channel)
      result.corners[i][channel] = static_cast<float>(chunk.vertex_color[vertex][channel]) / 255.0f * lit;
  }
  return result;
}

void InterpolatedColors::at(int32_t x, int32_t y, float (&color)[3]) const {
  double own[3];
  const double sum = weights.clamped_at(x + 0.5, y + 0.5, own);
  for (int channel = 0; channel < 3; ++channel) {
    const double mixed = (own[0] * static_cast<double>(corners[0][channel]) +
                          own[1] * static_cast<double>(corners[1][channel])) +
                         own[2] * static_cast<double>(corners[2][channel]);
    color[channel] = sum > 0 ? static_cast<float>(mixed / sum) : corners[0][channel];
  }
}

}  // namespace triptych
