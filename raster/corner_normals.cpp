#include "raster/corner_normals.hpp"

#include "visibility/shading.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

/// The light differs by less than this, and normals by less than 11 degrees: one colour is as good.
constexpr float even_light = 1.5f / 255, even_cosine = 0.98f;

/// The cofactors of a placement: what takes normals to eye space, to no certain length.
struct NormalTerms {
  explicit NormalTerms(const PlacedLattice& placed) {
    glm::vec3 linear[3];
    float most = 0;
    for (int i = 0; i < 3; ++i) {
      linear[i] = glm::vec3(placed.rows[i]);
      for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(linear[i][k]));
    }
    // So that products neither overflow nor vanish.
    for (glm::vec3& row : linear) row = row / most;
    for (int i = 0; i < 3; ++i) rows[i] = glm::cross(linear[(i + 1) % 3], linear[(i + 2) % 3]);
  }
  glm::vec3 rows[3];
};

}  // namespace

glm::vec3 unit_or_zero(const glm::vec3& v) {
  const float length = std::sqrt((v.x * v.x + v.y * v.y) + v.z * v.z);
  return length > 0 ? v / length : glm::vec3(0);
}

float light_on(const glm::vec3& normal, const glm::vec3& light) {
  const float towards = (normal.x * light.x + normal.y * light.y) + normal.z * light.z;
  return (ambient_light + diffuse_light * std::abs(towards)) + head_light * std::abs(normal.z);
}

CornerLights corner_normals(const SlotTable::Triangle& shown, const glm::vec3& light) {
  const RasterChunk& chunk = *shown.range->chunk;
  const NormalTerms terms(shown.range->placed);
  CornerLights result;
  float lights[3];
  for (size_t i = 0; i < 3; ++i) {
    const auto own = direction_of<glm::vec3>(chunk.vertex_normal[chunk.corner[i][shown.triangle]]);
    const auto along = [&](const glm::vec3& row) { return (row.x * own.x + row.y * own.y) + row.z * own.z; };
    result.eye[i] = unit_or_zero({along(terms.rows[0]), along(terms.rows[1]), along(terms.rows[2])});
    lights[i] = light_on(result.eye[i], light);
  }
  const auto [least, most] = std::minmax({lights[0], lights[1], lights[2]});
  const auto differ = [&](size_t i, size_t k) {
    const glm::vec3 &a = result.eye[i], &b = result.eye[k];
    return (a.x * b.x + a.y * b.y) + a.z * b.z < even_cosine;
  };
  result.bends = most - least > even_light || differ(0, 1) || differ(1, 2) || differ(2, 0);
  result.light = ((lights[0] + lights[1]) + lights[2]) / 3.0f;
  return result;
}

}  // namespace triptych
