// Lines in model space as a device draws them over a picture: boxes and frustums, for people to look at.
#pragma once

#include "scene/box.hpp"
#include "scene/camera.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace triptych {

/// From one position to another, in clip space; red, green, blue and alpha from 0 to 1.
struct ScreenLine {
  glm::vec4 from, to, color;
};

/// Gathers lines under one view, cut at its near plane. Ends are taken relative to the eye in doubles.
class ScreenLines {
 public:
  explicit ScreenLines(const View& view);
  void add_line(const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color);
  /// The box's twelve edges.
  void add_box(const Box& box, const glm::vec4& color);
  /// The four edges of the view's frustum and its rectangle, `depth` model units from its eye.
  void add_frustum(const View& view, double depth, const glm::vec4& color);
  std::span<const ScreenLine> lines() const { return lines_; }

 private:
  glm::vec4 project(const glm::dvec3& position) const;

  View view_;
  glm::dmat3 rotation_;
  std::vector<ScreenLine> lines_;
};

}  // namespace triptych
