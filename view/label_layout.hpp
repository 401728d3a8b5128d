// Where words stand in a picture so that none hide others. Pure; pixels from left and top.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace triptych {

struct ScreenBox {
  glm::dvec2 lo{0}, hi{0};
  bool overlaps(const ScreenBox& other) const {
    return lo.x < other.hi.x && other.lo.x < hi.x && lo.y < other.hi.y && other.lo.y < hi.y;
  }
  bool operator==(const ScreenBox&) const = default;
};

/// One picture's. What is placed first keeps its place whatever comes later.
class LabelLayout {
 public:
  /// gap: between an anchor and what stands beside it.
  LabelLayout(const glm::dvec2& picture, double gap) : picture_(picture), gap_(gap) {}

  /// Nothing is placed there from now on.
  void take(const ScreenBox& box) { taken_.push_back(box); }
  /// The place of something of that size, no larger than the picture, in it and beside the anchor: to its
  /// right where that is free, else around it, further and further away. Where nothing is free, where it
  /// hides the least.
  ScreenBox place(const glm::dvec2& anchor, const glm::dvec2& size);

 private:
  ScreenBox inside(ScreenBox box) const;
  double hidden_by(const ScreenBox& box) const;

  glm::dvec2 picture_;
  double gap_;
  std::vector<ScreenBox> taken_;
};

}  // namespace triptych
