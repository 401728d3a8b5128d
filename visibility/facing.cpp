#include "visibility/facing.hpp"

#include "base/rounding.hpp"

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace triptych {

int32_t outward_front(const FrameView& view, const Affine& transform, std::span<const LatticeBox> boxes) {
  if (!view.rules.leave_out_backs) return 0;
  if (!view.section_place(boxes).inside()) return 0;
  const NearestRounding rounding;
  const bool is_clear = std::all_of(
      boxes.begin(), boxes.end(), [&](const LatticeBox& box) { return view.eye_space.is_beyond_near(box); });
  if (view.rules.backs_need_distance && !is_clear) return 0;
  return glm::determinant(glm::dmat3(transform)) < 0 ? -1 : 1;
}

}  // namespace triptych
