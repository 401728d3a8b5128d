#include "raster/caps.hpp"

#include "visibility/cap_look.hpp"
#include "visibility/shading.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

Caps::Caps(const FrameView& view, const SamplePlace& place) : sides_(view, place) {
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

}  // namespace triptych
