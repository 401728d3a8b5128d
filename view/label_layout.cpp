#include "view/label_layout.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>

namespace triptych {

namespace {
/// From the anchor, in halves of the size and gaps: right, left, above, below, and the corners.
constexpr std::array<glm::dvec2, 8> directions = {
    {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}}};
constexpr int most_rings = 12;
}  // namespace

ScreenBox LabelLayout::inside(ScreenBox box) const {
  const glm::dvec2 size = box.hi - box.lo;
  box.lo = glm::max(glm::min(box.lo, picture_ - size), glm::dvec2(0));
  box.hi = box.lo + size;
  return box;
}

double LabelLayout::hidden_by(const ScreenBox& box) const {
  double area = 0;
  for (const ScreenBox& other : taken_) {
    if (!box.overlaps(other)) continue;
    const glm::dvec2 shared = glm::min(box.hi, other.hi) - glm::max(box.lo, other.lo);
    area += shared.x * shared.y;
  }
  return area;
}

ScreenBox LabelLayout::place(const glm::dvec2& anchor, const glm::dvec2& size) {
  ScreenBox best;
  double least = std::numeric_limits<double>::infinity();
  for (int ring = 0; ring < most_rings && least > 0; ++ring) {
    for (const glm::dvec2& direction : directions) {
      const glm::dvec2 middle = anchor + direction * (size * 0.5 + gap_ * (1.0 + ring) + ring * 0.5 * size.y);
      const ScreenBox box = inside({middle - size * 0.5, middle + size * 0.5});
      const double hidden = hidden_by(box);
      if (hidden < least) {
        best = box;
        least = hidden;
      }
      if (least == 0) break;
    }
  }
  take(best);
  return best;
}

}  // namespace triptych
