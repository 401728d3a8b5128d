// Cuts against the definition of the pixel error: points of the box, moved by δ, projected in long double.
#include "lod/cut.hpp"
#include "nodes/injected_rules.hpp"
#include "tests/hard_cases/trials.hpp"
#include "tests/support/scenes.hpp"

#include <cmath>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace triptych::hard_cases {

namespace {

using Precise = glm::vec<3, long double>;

class CutJudge {
 public:
  CutJudge(const Skeleton& skeleton, const FrameState& state)
      : skeleton_(skeleton),
        view_(state.view),
        rotation_(view_.rotation()),
        pixel_error_(state.pixel_error),
        frame_(skeleton, state, injected_frame_rules()),
        cut_(select_cut(frame_)),
        random_(7) {}

  Problems judge() {
    for (SceneNodeId node = 0; node < skeleton_.scene_nodes.size() && problems_.size() < 3; ++node) {
      const bool leaf = skeleton_.scene_nodes[node].child_count == 0;
      const bool chosen = cut_.choice[node] < Cut::inner;
      if (leaf && !covered(node)) expect_outside(node);
      if (chosen) expect_within_pixel_error(node);
    }
    return std::move(problems_);
  }

 private:
  bool covered(SceneNodeId node) const {
    for (; node != no_id; node = skeleton_.scene_nodes[node].parent) {
      if (cut_.choice[node] < Cut::inner) return true;
    }
    return false;
  }

  /// A point of the node's box in eye space: first the corners, then points at random.
  Precise sample(SceneNodeId node, int i) {
    const Box box = skeleton_.lattice().box(frame_.box(node));
    const glm::dvec3 point = i < 8 ? box.corner(i) : box.lo + (box.hi - box.lo) * random_.vector();
    return rotation_ * (Precise(point) - Precise(view_.camera.eye));
  }

  /// Well inside, so that the last bit does not matter.
  bool in_frustum(const Precise& p) const {
    const Camera& camera = view_.camera;
    const long double depth = -p.z, sure = 1e-9L;
    const long double w = camera.orthographic() ? 1 : depth;
    const long double width = (camera.right - camera.left) * w, height = (camera.top - camera.bottom) * w;
    return depth > camera.near * (1 + sure) && p.x > camera.left * w + sure * width &&
           p.x < camera.right * w - sure * width && p.y > camera.bottom * w + sure * height &&
           p.y < camera.top * w - sure * height;
  }

  void expect_outside(SceneNodeId node) {
    for (int i = 0; i < 40; ++i) {
      if (!in_frustum(sample(node, i))) continue;
      problems_.push_back(fmt::format("leaf {} reaches into the frustum and nothing stands for it", node));
      return;
    }
  }

  void expect_within_pixel_error(SceneNodeId node) {
    const SceneNode& scene_node = skeleton_.scene_nodes[node];
    const DrawableId id = cut_.choice[node];
    if (scene_node.child_count == 0 && id == scene_node.first_drawable) return;  // there is nothing finer
    const long double error = skeleton_.drawables[id].error;
    for (int i = 0; i < 60; ++i) {
      const Precise at = sample(node, i);
      if (!in_frustum(at)) continue;
      for (const Precise& direction : directions(at)) {
        const long double movement = moves(at, at + direction * error);
        if (movement <= pixel_error_ * (1 + 1e-9L)) continue;
        problems_.push_back(
            fmt::format("drawable {} may move by {} pixels", id, static_cast<double>(movement)));
        return;
      }
    }
  }

  /// The worst displacement there is, the one towards the eye, and one at random.
  std::vector<Precise> directions(const Precise& at) {
    std::vector<Precise> result;
    const auto add = [&](const Precise& direction) {
      const long double length = glm::length(direction);
      if (length > 0 && std::isfinite(length)) result.push_back(direction / length);
    };
    const long double lateral = at.x * at.x + at.y * at.y;
    add({at.x, at.y, -at.z > 0 ? lateral / -at.z : 0});
    add({-at.y, at.x, 0});
    add({1, 0, 0});
    add(-at);
    add(Precise(random_.vector(-1, 1)));
    return result;
  }

  long double moves(const Precise& at, const Precise& to) const {
    const bool parallel = view_.camera.orthographic();
    if (!parallel && to.z >= 0) return std::numeric_limits<long double>::infinity();
    const long double w0 = parallel ? 1 : -at.z, w1 = parallel ? 1 : -to.z;
    return std::hypot((to.x / w1 - at.x / w0) * view_.focal_x(), (to.y / w1 - at.y / w0) * view_.focal_y());
  }

  const Skeleton& skeleton_;
  const View view_;
  glm::mat<3, 3, long double> rotation_;
  double pixel_error_;
  FrameView frame_;
  Cut cut_;
  scenes::Random random_;
  Problems problems_;
};

}  // namespace

Problems cut_problems(const Trial& trial) {
  Problems problems;
  const BuiltTrial built(trial);
  for (size_t frame = 0; frame < std::min<size_t>(trial.views.size(), 24) && problems.empty(); ++frame) {
    FrameState state = trial.state_of(frame);
    state.section = {};
    for (const double pixel_error : {trial.pixel_error, trial.pixel_error * 4}) {
      state.pixel_error = pixel_error;
      for (const std::string& problem : CutJudge(built.pack().skeleton(), state).judge())
        problems.push_back(fmt::format("frame {} at {} pixels: {}", frame, pixel_error, problem));
    }
  }
  return problems;
}

}  // namespace triptych::hard_cases
