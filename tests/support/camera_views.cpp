#include "tests/support/scenes.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

namespace triptych::scenes {

namespace {

class PathMaker {
 public:
  PathMaker(const Skeleton& skeleton, int width, int height, uint32_t seed)
      : box_(skeleton.lattice().box(skeleton.scene_nodes[0].box)),
        size_(skeleton.diagonal()),
        near_(skeleton.default_near()),
        width_(width),
        height_(height),
        random_(seed) {
    for (const SceneNode& node : skeleton.scene_nodes) {
      if (node.child_count == 0) leaves_.push_back(skeleton.lattice().box(node.box));
    }
  }

  View& look(const glm::dvec3& eye, const glm::dvec3& target, double field_of_view = 60) {
    View view{.camera = {.eye = eye, .target = target, .up = {0, 0, 1}}, .width = width_, .height = height_};
    if (view.camera.target == eye) view.camera.target.x += size_;
    const glm::dvec3 forward = glm::normalize(view.camera.target - eye);
    if (std::abs(forward.z) > 0.99) view.camera.up = {0, 1, 0};
    set_field_of_view(view.camera, field_of_view, static_cast<double>(width_) / height_);
    view.camera.near = near_;
    views_.push_back(view);
    return views_.back();
  }

  void walk_and_turn() {
    const glm::dvec3 start = at({0.2, 0.3, 0.45}), end = at({0.45, 0.6, 0.5});
    for (int i = 0; i < 6; ++i) look(start + (end - start) * (i / 6.0), at({0.9, 0.7, 0.4}));
    for (int i = 0; i < 8; ++i) {
      const double angle = i * glm::pi<double>() / 4;
      look(end, end + glm::dvec3(std::cos(angle), std::sin(angle), 0.1));
    }
  }

  /// In the middle of boxes, on their faces along and across them, and with a near plane that cuts them.
  void boxes() {
    for (int i = 0; i < 6; ++i) {
      const Box& leaf = leaves_[random_.index(leaves_.size())];
      const Box& other = leaves_[random_.index(leaves_.size())];
      const glm::dvec3 middle = (leaf.lo + leaf.hi) * 0.5, away = (other.lo + other.hi) * 0.5;
      look(middle, away);
      glm::dvec3 face = middle;
      const int axis = i % 3;
      face[axis] = leaf.lo[axis];
      glm::dvec3 along = face;
      along[(axis + 1) % 3] += size_;
      look(face, along);
      glm::dvec3 outside = face;
      outside[axis] -= size_ * 0.02;
      look(outside, middle).camera.near = size_ * 0.02 * (0.9 + 0.04 * i);
      outside[axis] -= near_;
      look(outside, face).camera.near = size_ * 0.02 + near_;
    }
  }

  /// From far away through long lenses, where rounding is as large in pixels as it gets.
  void telescopes(size_t count) {
    for (size_t i = 0; i < count; ++i) {
      const double distance = std::exp2(random_.number(3, 10));
      const glm::dvec3 from = glm::normalize(random_.vector(-1, 1) + glm::dvec3(0, 0, 1e-3));
      const double lens = 2 * glm::degrees(std::atan(random_.number(0.2, 0.5) / distance));
      look(at({0.5, 0.5, 0.5}) + from * (size_ * distance), at({0.5, 0.5, 0.5}), lens);
    }
  }

  void jumps(size_t count) {
    for (size_t i = 0; i < count; ++i) {
      const double outwards = i % 8 == 7 ? 30 : 1.4;
      const glm::dvec3 eye = at(glm::dvec3(0.5) + random_.vector(-0.5, 0.5) * outwards);
      constexpr std::array<double, 5> fields_of_view = {60, 25, 110, 150, 3};
      View& view = look(eye, at(random_.vector()), fields_of_view[i % fields_of_view.size()]);
      if (i % 6 == 5) {
        view.camera.left *= 0.2;
        view.camera.top *= 1.7;
      }
      if (i % 5 == 4) view.camera.near = size_ * random_.number(0.001, 0.2);
    }
  }

  /// Orthographic: from before the scene, from far away, within it, along an axis, of a detail.
  void parallel() {
    const auto look_along = [&](const glm::dvec3& from, const glm::dvec3& to, double height) {
      View& view = look(at(from), at(to));
      set_orthographic_height(view.camera, size_ * height, static_cast<double>(width_) / height_);
    };
    look_along({1.4, 1.6, 1.3}, {0.5, 0.5, 0.5}, 1.1);
    look_along({1.4, 1.6, 1.3}, {0.5, 0.5, 0.45}, 0.9);
    look_along({-3000, 4000, 2000}, {0.5, 0.5, 0.5}, 0.7);
    look_along({0.5, 0.5, 0.5}, {0.9, 0.7, 0.4}, 0.4);
    look_along({0.5, 0.5, 3}, {0.5, 0.5, 0}, 1);
    look_along({0.3, -2, 0.4}, {0.3, 2, 0.4}, 0.05);
  }

  std::vector<View> take() { return std::move(views_); }

 private:
  /// A point of the scene's box, 0 to 1 along each side.
  glm::dvec3 at(const glm::dvec3& share) const { return box_.lo + (box_.hi - box_.lo) * share; }

  Box box_;
  double size_, near_;
  int width_, height_;
  Random random_;
  std::vector<Box> leaves_;
  std::vector<View> views_;
};

}  // namespace

std::vector<View> path(const Skeleton& skeleton, int width, int height, uint32_t seed) {
  PathMaker maker(skeleton, width, height, seed);
  maker.walk_and_turn();
  maker.boxes();
  maker.telescopes(8);
  maker.jumps(16);
  maker.parallel();
  return maker.take();
}

std::vector<View> random_views(const Skeleton& skeleton, int width, int height, size_t count, uint32_t seed) {
  PathMaker maker(skeleton, width, height, seed);
  maker.jumps(count);
  return maker.take();
}

double pixel_error(size_t frame) {
  constexpr std::array<double, 5> errors = {1, 0.5, 2, 8, 1};
  return errors[frame / 3 % errors.size()];
}

}  // namespace triptych::scenes
