#include "simplify/edge_collapse.hpp"

#include "simplify/sunk_points.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace triptych {
namespace {

/// A point whose cost is more than this many times the current one is evaluated again when something around
/// it changes.
constexpr float stale = 32;

}  // namespace

EdgeCollapse::EdgeCollapse(const Surface& surface, std::span<const uint8_t> locked,
                           const LayeredPlanes& planes)
    : mesh_(surface),
      locked_(locked),
      collapser_(surface.points.size(), planes, sunk_points(surface)),
      targets_(surface.points.size(), Collapser::any),
      costs_(surface.points.size(), -1),
      queued_(surface.points.size(), -1),
      steps_(surface.points.size(), 0),
      disturbed_(surface.points.size(), 1) {
  waiting_.reserve(surface.points.size());
  const LatticeBox box = surface.box();
  longest_ = Collapser::length_weight * glm::length(glm::dvec3(box.hi) - glm::dvec3(box.lo)) * 1.001;
  look_again(0);
  Star star;
  for (uint32_t i = 0; i < locked_.size(); ++i) {
    if (locked_[i] && star.read(mesh_, i)) crowded_triangles_ += star.crowd();
  }
}

/// Evaluates all points without a possible collapse again: a collapse also depends on what lies around the
/// target, so there may be one now.
void EdgeCollapse::look_again(double cost) {
  looked_at_ = cost;
  looked_with_ = triangle_count();
  if (was_looked_at_) spread_disturbance();
  for (uint32_t i = 0; i < costs_.size(); ++i) {
    if (!disturbed_[i] || (costs_[i] >= 0 && !(costs_[i] > stale * static_cast<float>(cost))) ||
        (!locked_.empty() && locked_[i]))
      continue;

    const Collapse* collapse = collapser_.find(mesh_, i);
    if (!was_looked_at_) crowded_triangles_ += collapser_.star().crowd();
    if (!collapse) {
      continue;
    }
    set_cost(i, *collapse);
    queued_[i] = costs_[i];
    waiting_.push_back({costs_[i], i});
  }
  was_looked_at_ = true;
  std::fill(disturbed_.begin(), disturbed_.end(), 0);
  std::make_heap(waiting_.begin(), waiting_.end());
}

/// The cost of a collapse depends only on the stars of the point and of its neighbours.
void EdgeCollapse::spread_disturbance() {
  std::vector<uint8_t> near = disturbed_;
  for (uint32_t triangle = 0; triangle < mesh_.face_count(); ++triangle) {
    const auto& corners = mesh_.face(triangle).corners;
    if (corners[0] == ShrinkingMesh::gone) continue;
    if (disturbed_[corners[0]] || disturbed_[corners[1]] || disturbed_[corners[2]]) {
      for (const uint32_t corner : corners) near[corner] = 1;
    }
  }
  disturbed_ = std::move(near);
}

void EdgeCollapse::push(const Waiting& waiting) {
  waiting_.push_back(waiting);
  std::push_heap(waiting_.begin(), waiting_.end());
}

void EdgeCollapse::set_cost(uint32_t point, const Collapse& collapse) {
  targets_[point] = collapse.target;
  costs_[point] = static_cast<float>(collapse.cost);
  steps_[point] = static_cast<float>(collapse.cost - collapse.error_before);
}

void EdgeCollapse::changed(uint32_t point, double error, double cost) {
  targets_[point] = Collapser::any;
  disturbed_[point] = 1;
  if (!locked_.empty() && locked_[point]) return;
  if (costs_[point] < 0 || costs_[point] > stale * static_cast<float>(cost)) {
    // Its collapse may be possible now, or have become cheaper.
    queued_[point] = costs_[point] = static_cast<float>(cost);
    steps_[point] = 0;
    push({costs_[point], point});
  } else {
    // The surface around it has moved; its collapse adds at least half as much as before. It is evaluated
    // again when it is next in the queue.
    costs_[point] = std::max(costs_[point], static_cast<float>(error) + steps_[point] / 2);
  }
}

bool EdgeCollapse::reduce_to(size_t triangles, double max_bound) {
  std::vector<Waiting> too_far;
  const double beyond = max_bound + longest_;
  while (triangle_count() > triangles) {
    // Costs are bounds plus a little for long edges: others may still be within the limit.
    const auto at_end = [&] { return waiting_.empty() || waiting_.front().cost > beyond; };
    if (at_end() ? triangle_count() < looked_with_
                 : waiting_.front().cost > 2 * looked_at_ && triangle_count() * 8 < looked_with_ * 7) {
      look_again(at_end() ? looked_at_ : waiting_.front().cost);
    }
    if (at_end()) break;
    const Waiting next = waiting_.front();
    std::pop_heap(waiting_.begin(), waiting_.end());
    waiting_.pop_back();
    if (next.cost != queued_[next.point]) continue;
    if (costs_[next.point] > next.cost) {
      queued_[next.point] = costs_[next.point];
      push({costs_[next.point], next.point});
      continue;
    }
    costs_[next.point] = queued_[next.point] = -1;
    const Collapse* collapse = collapser_.find(mesh_, next.point, targets_[next.point]);
    if (!collapse) {
      continue;
    }
    // What was cheap when it was queued may have become expensive.
    const bool is_next = waiting_.empty() || static_cast<float>(collapse->cost) <= waiting_.front().cost;
    if (!is_next || collapse->bound > max_bound) {
      set_cost(next.point, *collapse);
      queued_[next.point] = costs_[next.point];
      if (!is_next) {
        push({costs_[next.point], next.point});
      } else {
        too_far.push_back({costs_[next.point], next.point});
      }
      continue;
    }
    bound_ = std::max(bound_, collapse->bound);
    planes_left_ = std::max(planes_left_, collapse->planes_left);
    const double cost = collapse->cost;
    collapser_.apply(mesh_);
    const auto spokes = collapser_.star().spokes();
    for (size_t i = 0; i < spokes.size(); ++i) {
      changed(spokes[i].from, collapse->errors[i], cost);
      changed(spokes[i].to, collapse->errors[i], cost);
    }
    for (const auto& [triangle, error] : collapse->beside) {
      for (const uint32_t corner : mesh_.face(triangle).corners) changed(corner, error, cost);
    }
  }
  for (const Waiting& waiting : too_far) push(waiting);
  return !waiting_.empty();
}

}  // namespace triptych
