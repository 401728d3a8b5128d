#include "raster/caps.hpp"

#include "raster/triangle_shader.hpp"
#include "visibility/cap_look.hpp"
#include "visibility/shading.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

Caps::Caps(const FrameView& view, const SamplePlace& place)
    : sides_(view, place), orthographic_(view.clip.orthographic) {
  const glm::vec3 light = light_direction(view);
  for (size_t i = 0; i < sides_.all().size(); ++i) {
    const glm::vec3& normal = sides_.normal(i);
    lights_[i] = cap_tone * ((ambient_light + diffuse_light * std::abs(glm::dot(normal, light))) +
                             head_light * std::abs(normal.z));
  }
}

bool mirrors(const PlacedLattice& placed) {
  const glm::dvec3 x(placed.rows[0]), y(placed.rows[1]), z(placed.rows[2]);
  return glm::dot(glm::cross(x, y), z) < 0;
}

bool Caps::lie_before(const SlotTable::Triangle& shown) const {
  const DrawnRange& range = *shown.range;
  const RasterChunk& chunk = *range.chunk;
  if (range.cut == 0 || !chunk.is_outward(shown.triangle)) return false;
  const uint32_t corner = chunk.corner[0][shown.triangle];
  const glm::dvec3 point(glm::ivec3(chunk.x[corner], chunk.y[corner], chunk.z[corner]) + range.placed.cell);
  glm::dvec3 position;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec4 row(range.placed.rows[i]);
    position[i] = glm::dot(glm::dvec3(row), point) + row.w;
  }
  const glm::dvec3 normal(TriangleShader::normal(shown));
  const double outwards = orthographic_ ? normal.z : -glm::dot(normal, position);
  return mirrors(range.placed) ? outwards > 0 : outwards < 0;
}

}  // namespace triptych
