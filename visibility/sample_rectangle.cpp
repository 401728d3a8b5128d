#include "visibility/sample_rectangle.hpp"

namespace triptych {

namespace {

/// In normalised device coordinates.
glm::dvec2 offset_of(const SamplePlace& place, int width, int height) {
  return 2.0 * place.pixels() / glm::dvec2(width, height);
}

float minus(float side, double offset) { return static_cast<float>(double{side} - offset); }

/// of + along · offset, rounded once.
float moved(float of, const glm::vec2& along, const glm::dvec2& offset) {
  return static_cast<float>(double{of} + (double{along.x} * offset.x + double{along.y} * offset.y));
}

}  // namespace

ScreenRectangle at_sample(const ScreenRectangle& rectangle, const SamplePlace& place, int width, int height) {
  const glm::dvec2 offset = offset_of(place, width, height);
  ScreenRectangle seen = rectangle;
  seen.left = minus(rectangle.left, offset.x);
  seen.bottom = minus(rectangle.bottom, offset.y);
  seen.right = minus(rectangle.right, offset.x);
  seen.top = minus(rectangle.top, offset.y);
  for (DepthPlane& plane : seen.planes) plane.middle = moved(plane.middle, plane.slope, offset);
  for (HalfPlane& cut : seen.cuts) cut.offset = moved(cut.offset, cut.normal, offset);
  return seen;
}

ScreenExtent at_sample(const ScreenExtent& extent, const SamplePlace& place, int width, int height) {
  const glm::dvec2 offset = offset_of(place, width, height);
  return {.left = minus(extent.left, offset.x),
          .bottom = minus(extent.bottom, offset.y),
          .right = minus(extent.right, offset.x),
          .top = minus(extent.top, offset.y),
          .nearest = extent.nearest};
}

}  // namespace triptych
