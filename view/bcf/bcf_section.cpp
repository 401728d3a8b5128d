#include "view/bcf/bcf.hpp"

#include <algorithm>
#include <optional>

namespace triptych {

namespace {

/// BCF has planes only, so a box comes as six of them: those are taken out of the planes. Nullopt, and
/// nothing is taken, where one of its sides is missing.
std::optional<Box> take_box(std::vector<SectionPlane>& planes) {
  constexpr double along_axis = 1e-9;
  Box box;
  std::vector<size_t> sides;
  for (int side = 0; side < 6; ++side) {
    glm::dvec3 normal(0);
    normal[side / 2] = side % 2 == 0 ? 1 : -1;
    // From the end, where planes_of() has those of a box: others may lie along an axis, too.
    const auto found = std::find_if(planes.rbegin(), planes.rend(), [&](const SectionPlane& plane) {
      return glm::distance(plane.normal, normal) < along_axis;
    });
    if (found == planes.rend()) return std::nullopt;
    sides.push_back(static_cast<size_t>(planes.rend() - found) - 1);
    if (side % 2 == 0) {
      box.lo[side / 2] = found->offset;
    } else {
      box.hi[side / 2] = -found->offset;
    }
  }
  if (box.empty()) return std::nullopt;
  std::sort(sides.rbegin(), sides.rend());
  for (const size_t side : sides) planes.erase(planes.begin() + static_cast<std::ptrdiff_t>(side));
  return box;
}

}  // namespace

Section section_of(const Viewpoint& viewpoint, const std::string& place) {
  std::vector<SectionPlane> planes = viewpoint.planes;
  Section section;
  if (const auto box = take_box(planes)) section.set_box(*box, place);
  for (const SectionPlane& plane : planes) section.add_plane(plane, place);
  return section;
}

std::vector<SectionPlane> planes_of(const Section& section) {
  const SectionSides sides(section);
  return {sides.all().begin(), sides.all().end()};
}

}  // namespace triptych
