#include "lod/section_space.hpp"

#include "lod/eye_space.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace triptych {

namespace {
constexpr double snapping = 1.0 / 128;  // pixels
/// What rounding moves vertices by, as a share of the distance, under all but the worst transforms: less than
/// half a pixel of a lens of a hundredth of a degree.
constexpr double common_rounding = 0x1p-20;
}  // namespace

SectionSpace::SectionSpace(const FrameState& state, const ClipSpace& clip, double focal_length)
    : sides_(state.section), eye_(state.view.camera.eye), orthographic_(clip.orthographic) {
  const double rounding = common_rounding * (orthographic_ ? clip.range : state.view.corner_stretch());
  tolerance_ = rounding + snapping / focal_length;
}

SectionPlace SectionSpace::place(const Box& box, double rounding) const {
  SectionPlace place;
  const glm::dvec3 centre = (box.lo + box.hi) * 0.5, half = (box.hi - box.lo) * 0.5;
  const double farthest = orthographic_ ? 1 : glm::length(centre - eye_) + glm::length(half);
  const double margin = 2 * rounding + tolerance_ * farthest;
  uint32_t bit = 1;
  for (const SectionPlane& side : sides_.all()) {
    const double distance = side.distance(centre), reach = glm::dot(glm::abs(side.normal), half);
    if (distance + reach < -margin) place.outside = true;
    if (!(distance - reach > margin)) place.cut |= bit;
    bit <<= 1;
  }
  return place;
}

}  // namespace triptych
