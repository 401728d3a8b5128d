#include "view/birds_eye.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

/// How far nine of ten of the boxes' centres lie from the eye along the ground.
double reach_along_ground(const Skeleton& skeleton, const View& view, const std::vector<DrawableId>& cut) {
  const glm::dvec3 up = glm::normalize(view.camera.up);
  std::vector<double> distances = {0};
  for (const DrawableId id : cut) {
    const Box box = skeleton.lattice().box(skeleton.scene_nodes[skeleton.drawables[id].scene_node].box);
    const glm::dvec3 offset = (box.lo + box.hi) * 0.5 - view.camera.eye;
    distances.push_back(glm::length(offset - glm::dot(offset, up) * up));
  }
  const auto wanted = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 9 / 10);
  std::nth_element(distances.begin(), wanted, distances.end());
  return *wanted;
}

}  // namespace

View birds_eye_view(const Skeleton& skeleton, const View& view, const std::vector<DrawableId>& cut) {
  const glm::dvec3 up = glm::normalize(view.camera.up);
  const glm::dvec3 sight = glm::normalize(view.camera.target - view.camera.eye);
  const glm::dvec3 level = sight - glm::dot(sight, up) * up;
  const glm::dvec3 aside = std::abs(up.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 ahead = glm::length(level) > 1e-6 ? level : aside - glm::dot(aside, up) * up;
  // In steps, so that the picture's scale does not change with every step of a walk.
  const double reach = std::max(reach_along_ground(skeleton, view, cut), 10 * view.camera.near);
  const double covered = std::exp2(std::ceil(2 * std::log2(reach)) / 2);
  View above{.camera = {.eye = view.camera.eye + covered * up,
                        .target = view.camera.eye,
                        .up = glm::normalize(ahead)},
             .width = view.width,
             .height = view.height};
  set_field_of_view(above.camera, 90, static_cast<double>(view.width) / view.height);
  if (view.width < view.height) {  // the narrow side covers it
    const double scale = static_cast<double>(view.height) / view.width;
    for (double* side : {&above.camera.left, &above.camera.right, &above.camera.bottom, &above.camera.top}) {
      *side *= scale;
    }
  }
  constexpr double above_the_eye = 0.02;
  above.camera.near = covered * (1 - above_the_eye);
  return above;
}

const FrameTarget& BirdsEye::draw(const FrameView& frame, const VisibleSet& visible) {
  const View& view = frame.view();
  if (!target_ || target_->width() != view.width || target_->height() != view.height)
    target_ = device_.make_target(TargetKind::color, view.width, view.height);
  const std::vector<DrawableId> cut = select_cut(frame).drawables;
  View above = birds_eye_view(skeleton_, view, cut);
  FrameState state = frame.state;
  state.view = above;
  const FrameView from_above(skeleton_, state, frame.rules);
  target_->begin(from_above);
  std::vector<DrawableId> ordered = visible;
  sort_by_rank(from_above, ordered);
  target_->draw(ordered);

  const glm::vec4 green(0.05f, 0.55f, 0.15f, 1), red(0.85f, 0.1f, 0.1f, 1), yellow(0.95f, 0.7f, 0, 1);
  const double covered = glm::length(above.camera.eye - above.camera.target);
  above.camera.near = covered / 100;
  ScreenLines lines(above);
  const auto add_box = [&](DrawableId id, const glm::vec4& color) {
    lines.add_box(skeleton_.lattice().box(from_above.box(skeleton_.drawables[id].scene_node)), color);
  };
  for (const DrawableId id : cut) {
    if (!std::binary_search(visible.begin(), visible.end(), id)) add_box(id, red);
  }
  for (const DrawableId id : visible) add_box(id, green);
  lines.add_frustum(view, covered, yellow);
  target_->draw_lines(lines.lines());
  return *target_;
}

}  // namespace triptych
