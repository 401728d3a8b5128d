#include "visibility/portal_view.hpp"

#include <algorithm>

namespace triptych {

PortalView::PortalView(const CellGraph& graph)
    : graph_(graph), seen_(graph.cells.size()), parts_(graph.cells.size()) {}

bool PortalView::applies_to(const FrameView& view) {
  return !view.view().camera.orthographic() && !view.state.hiding.objects && view.section_space.keeps_all();
}

void PortalView::begin(const FrameView& view) {
  view_.emplace(view);
  projector_.emplace(view);
  eye_ = view.view().camera.eye;
  near_reach_ =
      view.rules.near_plane_opens_walls ? 1.01 * view.view().camera.near * view.view().corner_stretch() : 0;
  pixel_ = 1 / std::min(view.view().focal_x(), view.view().focal_y());
  seen_.clear();
  seen_count_ = 0;
  waiting_.clear();

  // No wall before the near plane hides anything.
  const Box around{eye_ - near_reach_, eye_ + near_reach_};
  graph_.any_touched(around, open_, [&](uint32_t cell) {
    enter(cell, ScreenPart());
    return false;
  });
  if (!graph_.box.contains(around)) look_in_from_outside();
  for (size_t next = 0; next < waiting_.size(); ++next) {
    const auto [cell, part] = waiting_[next];
    look_out_of(cell, part);
  }
}

void PortalView::look_in_from_outside() {
  for (uint32_t id = 0; id < graph_.cells.size(); ++id) {
    const Box& box = graph_.cells[id].box;
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool up : {false, true}) {
        const double at = up ? box.hi[axis] : box.lo[axis];
        const double of_all = up ? graph_.box.hi[axis] : graph_.box.lo[axis];
        const double beyond = up ? eye_[axis] - at : at - eye_[axis];
        if (at != of_all || beyond < -near_reach_) continue;
        Box face = box;
        face.lo[axis] = face.hi[axis] = at;
        if (const auto part = on_screen(grown_by_pixels(face, 1, 0))) enter(id, *part);
      }
    }
  }
}

bool PortalView::is_before(const Portal& portal) const {
  const double at = portal.box.lo[portal.axis], eye = eye_[portal.axis];
  return portal.up ? eye <= at + near_reach_ : eye >= at - near_reach_;
}

void PortalView::look_out_of(uint32_t cell, const ScreenPart& part) {
  const SpaceCell& from = graph_.cells[cell];
  for (uint32_t i = from.first_portal; i < from.first_portal + from.portal_count; ++i) {
    const Portal& portal = graph_.portals[i];
    if (!is_before(portal)) continue;
    // Walls end where their levels' outlines do, which are up to the pixel error off.
    const double pixels = view_->state.pixel_error + 2;
    const auto opening = on_screen(grown_by_pixels(portal.box, pixels, 0));
    if (!opening) continue;
    const ScreenPart through = common(*opening, part);
    if (!through.empty()) enter(portal.to, through);
  }
}

bool PortalView::holds(const ScreenPart& a, const ScreenPart& b) {
  return a.left <= b.left && a.bottom <= b.bottom && a.right >= b.right && a.top >= b.top;
}

void PortalView::enter(uint32_t cell, const ScreenPart& part) {
  constexpr size_t most_parts = 16;  // then one takes their place, so that the walk ends soon
  std::vector<ScreenPart>& known = parts_[cell];
  if (seen_.mark_first(cell)) {
    ++seen_count_;
    known.clear();
  }
  if (std::any_of(known.begin(), known.end(), [&](const ScreenPart& of) { return holds(of, part); })) return;
  known.erase(
      std::remove_if(known.begin(), known.end(), [&](const ScreenPart& of) { return holds(part, of); }),
      known.end());
  ScreenPart all = part;
  if (known.size() == most_parts) {
    for (const ScreenPart& of : known) {
      all = {std::min(all.left, of.left), std::min(all.bottom, of.bottom), std::max(all.right, of.right),
             std::max(all.top, of.top)};
    }
    known.clear();
  }
  known.push_back(all);
  waiting_.emplace_back(cell, all);
}

PortalView::ScreenPart PortalView::common(const ScreenPart& a, const ScreenPart& b) {
  return {std::max(a.left, b.left), std::max(a.bottom, b.bottom), std::min(a.right, b.right),
          std::min(a.top, b.top)};
}

/// So many pixels at the box's farthest corner are as much nearer by.
Box PortalView::grown_by_pixels(const Box& box, double pixels, double more) const {
  const double farthest = glm::length(glm::max(glm::abs(box.lo - eye_), glm::abs(box.hi - eye_)));
  const double reach = pixels * (farthest + more) * pixel_ + more;
  return {box.lo - reach, box.hi + reach};
}

std::optional<PortalView::ScreenPart> PortalView::on_screen(const Box& box) const {
  const ScreenBounds bounds = projector_->bounds(view_->skeleton->lattice().enclosing(box));
  switch (bounds.kind) {
    case ScreenBounds::Kind::off_screen:
      return std::nullopt;
    case ScreenBounds::Kind::hidden:
    case ScreenBounds::Kind::unbounded:
      return ScreenPart();
    case ScreenBounds::Kind::rectangle:
      break;
  }
  const ScreenRectangle& rectangle = bounds.rectangle;
  return ScreenPart{rectangle.left, rectangle.bottom, rectangle.right, rectangle.top};
}

bool PortalView::may_see(const LatticeBox& box) {
  // The wall before it may be as far behind its place as its level's error.
  const Lattice& lattice = view_->skeleton->lattice();
  const Box grown = grown_by_pixels(lattice.box(box), view_->state.pixel_error, 2 * lattice.step);
  if (!graph_.box.contains(grown)) return true;
  std::optional<ScreenPart> part;
  return graph_.any_touched(grown, open_, [&](uint32_t cell) {
    if (!seen_.marked(cell)) return false;
    if (!part) {
      part = on_screen(grown);
      if (!part) part = ScreenPart();
    }
    return std::any_of(parts_[cell].begin(), parts_[cell].end(),
                       [&](const ScreenPart& of) { return !common(*part, of).empty(); });
  });
}

}  // namespace triptych
