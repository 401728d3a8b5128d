// What hard cases are made of: a model in the making, and cameras in one line.
#pragma once

#include "tests/hard_cases/hard_case.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/scenes.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace triptych::hard_cases {

using scenes::Random;

/// A model in the making; each mesh comes in the next of seven colours.
class Maker {
 public:
  Maker();
  Maker& mesh(Mesh mesh, const Affine& transform = Affine(1));
  /// Places the last mesh once more.
  Maker& place(const Affine& transform);
  Maker& box(const glm::dvec3& lo, const glm::dvec3& hi);
  Maker& triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
  /// A parallelogram at `corner`.
  Maker& quad(const glm::dvec3& corner, const glm::dvec3& side, const glm::dvec3& other_side);
  /// Boxes of random places and sizes in the box.
  Maker& clutter(int count, const glm::dvec3& lo, const glm::dvec3& hi, double size, uint32_t seed = 1);
  /// Makes a group of what was placed since the last one.
  uint32_t group();
  Maker& place_group(uint32_t group, const Affine& transform);
  /// What was placed since the last group stays in the model.
  Maker& keep();
  /// Moves what was placed since keep() by a joint that follows these tracks; returns the joint.
  uint32_t move(MotionJoint joint, const MotionTrack* translation, const MotionTrack* rotation,
                const MotionTrack* scale = nullptr);
  /// Takes the model out.
  Model model();

 private:
  Model model_;
  std::vector<Instance> kept_;
};

struct Size {
  int width = 96, height = 72;
};

View look(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_degrees = 60, Size size = {},
          double near = 0.01, const glm::dvec3& up = {0, 0, 1});
View look_parallel(const glm::dvec3& eye, const glm::dvec3& target, double height, Size size = {},
                   double near = 0.01, const glm::dvec3& up = {0, 0, 1});
/// Views from a circle around the point, a little from above.
std::vector<View> around(const glm::dvec3& middle, double distance, int count, double fov_y_degrees = 60,
                         Size size = {}, double near = 0.01);

Affine linear(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, const glm::dvec3& at = {});

/// Positions rounded to multiples of the step, a power of two.
Model snapped(Model model, double step);
Model moved(Model model, const glm::dvec3& by);
std::vector<View> moved(std::vector<View> views, const glm::dvec3& by);
Model scaled(Model model, double factor);
std::vector<View> scaled(std::vector<View> views, double factor);

/// Rooms and clutter with closed walls between: 16 x 8 x 3 units, coordinates in multiples of 1/4096.
Model small_house(uint32_t seed = 1);
/// A walk through it of eight frames.
std::vector<View> house_views(Size size = {});
/// The house and the walk in other units and then elsewhere; their twin is the house as it is. Equal where
/// both are exact in double: a power of two, coordinates of few bits.
Trial house_elsewhere(double scale, const glm::dvec3& by = {});

}  // namespace triptych::hard_cases
