#include "scene/transforms.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace triptych {

bool is_finite(const Affine& transform) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (!(std::abs(transform[column][row]) < max_coordinate)) return false;
    }
  }
  return true;
}

double largest_stretch(const Affine& transform) {
  // The largest eigenvalue of MᵀM, by Jacobi rotations.
  const glm::dmat3 matrix(transform);
  glm::dmat3 gram = glm::transpose(matrix) * matrix;
  for (int sweep = 0; sweep < 30; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (gram[p][q] == 0) continue;
        const double angle = 0.5 * std::atan2(2 * gram[p][q], gram[q][q] - gram[p][p]);
        glm::dmat3 rotation(1);
        rotation[p][p] = rotation[q][q] = std::cos(angle);
        rotation[q][p] = std::sin(angle);
        rotation[p][q] = -std::sin(angle);
        gram = glm::transpose(rotation) * gram * rotation;
      }
    }
  }
  return std::sqrt(std::max({gram[0][0], gram[1][1], gram[2][2], 0.0})) * (1 + 1e-12);
}

bool well_conditioned(const Affine& transform, double max_condition) {
  // Beyond this, which no change of units reaches, the untransformed mesh may be too small or too large to be
  // measured.
  constexpr double max_change = 1e20;
  const double stretch = largest_stretch(transform);
  if (!(stretch > 1 / max_change && stretch < max_change)) return false;
  const glm::dmat3 matrix(transform), inverse = glm::inverse(matrix);
  double sum = 0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      double entry = 0;
      for (int k = 0; k < 3; ++k) entry += std::abs(matrix[k][row]) * std::abs(inverse[column][k]);
      sum += entry * entry;
    }
  }
  // Written so that NaN is not well-conditioned. The identity's is √3.
  return sum <= max_condition * max_condition;
}

}  // namespace triptych
