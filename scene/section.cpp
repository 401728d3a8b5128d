#include "scene/section.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace triptych {

namespace {

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

void Section::add_plane(const SectionPlane& plane, const std::string& place) {
  if (plane_count_ == max_planes) fail(place, "more than {} section planes", max_planes);
  const double length = glm::length(plane.normal);
  if (!is_finite(plane.normal) || !std::isfinite(plane.offset) || !std::isfinite(length) || !(length > 0))
    fail(place, "a section plane needs a normal that has a length, and an offset");
  // A normal of length 1 keeps its bits: what was sent and read back is the same section.
  const bool is_unit = std::abs(length - 1) <= 0x1p-50;
  planes_[plane_count_++] = is_unit ? plane : SectionPlane{plane.normal / length, plane.offset / length};
}

void Section::set_box(const Box& box, const std::string& place) {
  if (!is_finite(box.lo) || !is_finite(box.hi) || box.empty())
    fail(place, "a section box needs corners, the lower one first");
  box_ = box;
}

void Section::remove_plane(uint32_t index) {
  assert(index < plane_count_);
  std::move(planes_.begin() + index + 1, planes_.begin() + plane_count_, planes_.begin() + index);
  planes_[--plane_count_] = {};
}

SectionSides::SectionSides(const Section& section) {
  for (const SectionPlane& plane : section.planes()) sides_[count_++] = plane;
  if (!section.box()) return;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 normal(0);
    normal[axis] = 1;
    sides_[count_++] = {normal, section.box()->lo[axis]};
    sides_[count_++] = {-normal, -section.box()->hi[axis]};
  }
}

}  // namespace triptych
