#include "raster/perspective_weights.hpp"

#include <glm/geometric.hpp>

namespace triptych {

PerspectiveWeights perspective_weights(const VertexStage& stage, int width, int height,
                                       const PlacedLattice& placed, const RasterChunk& chunk,
                                       uint32_t triangle) {
  PerspectiveWeights weights;
  glm::dvec3 corners[3];  // in pixels, times w
  for (size_t i = 0; i < 3; ++i) {
    const auto clip = stage.to_clip<glm::dvec4>(placed, chunk, chunk.corner[i][triangle]);
    corners[i] = {(clip.x + clip.w) * (0.5 * width), (clip.y + clip.w) * (0.5 * height), clip.w};
  }
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 weight = glm::cross(corners[(i + 1) % 3], corners[(i + 2) % 3]);
    for (int k = 0; k < 3; ++k) weights.of_corner[i][k] = weight[k];
  }
  return weights;
}

double PerspectiveWeights::clamped_at(double x, double y, double (&weights)[3]) const {
  for (int i = 0; i < 3; ++i) weights[i] = (of_corner[i][0] * x + of_corner[i][1] * y) + of_corner[i][2];
  const double whole = (weights[0] + weights[1]) + weights[2];
  double sum = 0;
  for (double& weight : weights) {
    weight /= whole;
    if (!(weight > 0)) weight = 0;
    if (weight > 1) weight = 1;
    sum += weight;
  }
  return sum;
}

void PerspectiveWeights::change(double x, double y, const double (&of_corners)[3], double value,
                                double& right, double& up) const {
  double whole = 0, slopes[2] = {0, 0}, sums[2] = {0, 0};
  for (int i = 0; i < 3; ++i) {
    whole += (of_corner[i][0] * x + of_corner[i][1] * y) + of_corner[i][2];
    for (int k = 0; k < 2; ++k) {
      slopes[k] += of_corner[i][k] * of_corners[i];
      sums[k] += of_corner[i][k];
    }
  }
  right = (slopes[0] - value * sums[0]) / whole;
  up = (slopes[1] - value * sums[1]) / whole;
}

}  // namespace triptych
