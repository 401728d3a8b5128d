#include "tests/hard_cases/maker.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <iterator>

namespace triptych::hard_cases {

namespace {
constexpr int colors = 7;
}

Maker::Maker() {
  for (int i = 0; i < colors; ++i) {
    model_.materials.push_back(
        {glm::vec4(0.1 + 0.12 * i, 0.9 - 0.13 * ((3 * i) % colors), 0.2 + 0.1 * ((5 * i) % colors), 1)});
  }
}

Maker& Maker::mesh(Mesh mesh, const Affine& transform) {
  const auto color = static_cast<uint32_t>(model_.meshes.size() % colors);
  for (Triangle& triangle : mesh.triangles) triangle.material = color;
  model_.meshes.push_back(std::move(mesh));
  return place(transform);
}

Maker& Maker::place(const Affine& transform) {
  model_.instances.push_back({static_cast<uint32_t>(model_.meshes.size() - 1), transform});
  return *this;
}

Maker& Maker::box(const glm::dvec3& lo, const glm::dvec3& hi) { return mesh(awkward::box(lo, hi)); }

Maker& Maker::triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return mesh({"triangle", {a, b, c}, {{{0, 1, 2}, 0}}});
}

Maker& Maker::quad(const glm::dvec3& corner, const glm::dvec3& side, const glm::dvec3& other_side) {
  return mesh({"quad",
               {corner, corner + side, corner + side + other_side, corner + other_side},
               {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}}});
}

Maker& Maker::clutter(int count, const glm::dvec3& lo, const glm::dvec3& hi, double size, uint32_t seed) {
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 corner = lo + (hi - lo) * random.vector();
    box(corner, corner + random.vector(0.1, 1) * size);
  }
  return *this;
}

uint32_t Maker::group() {
  model_.groups.push_back({std::move(model_.instances), std::move(model_.group_instances)});
  model_.instances.clear();
  model_.group_instances.clear();
  return static_cast<uint32_t>(model_.groups.size() - 1);
}

Maker& Maker::place_group(uint32_t group, const Affine& transform) {
  model_.group_instances.push_back({group, transform});
  return *this;
}

uint32_t Maker::move(MotionJoint joint, const MotionTrack* translation, const MotionTrack* rotation,
                     const MotionTrack* scale) {
  const auto add = [&](const MotionTrack* track, uint32_t& index) {
    if (track == nullptr) return;
    index = static_cast<uint32_t>(model_.motion.tracks.size());
    model_.motion.tracks.push_back(*track);
  };
  add(translation, joint.translation_track);
  add(rotation, joint.rotation_track);
  add(scale, joint.scale_track);
  const auto number = static_cast<uint32_t>(model_.motion.joints.size());
  model_.motion.joints.push_back(joint);
  model_.groups.push_back({std::move(model_.instances), {}});
  model_.instances = std::move(kept_);
  kept_.clear();
  const auto group = static_cast<uint32_t>(model_.groups.size() - 1);
  model_.group_instances.push_back({group, transform_at(model_.motion, number, 0)});
  model_.group_instances.back().joint = number;
  return number;
}

Maker& Maker::keep() {
  std::ranges::move(model_.instances, std::back_inserter(kept_));
  model_.instances.clear();
  return *this;
}

Model Maker::model() { return std::move(model_); }

View look(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_degrees, Size size, double near,
          const glm::dvec3& up) {
  View view{.camera = {.eye = eye, .target = target, .up = up}, .width = size.width, .height = size.height};
  set_field_of_view(view.camera, fov_y_degrees, static_cast<double>(size.width) / size.height);
  view.camera.near = near;
  return view;
}

View look_parallel(const glm::dvec3& eye, const glm::dvec3& target, double height, Size size, double near,
                   const glm::dvec3& up) {
  View view = look(eye, target, 60, size, near, up);
  set_orthographic_height(view.camera, height, static_cast<double>(size.width) / size.height);
  return view;
}

std::vector<View> around(const glm::dvec3& middle, double distance, int count, double fov_y_degrees,
                         Size size, double near) {
  std::vector<View> views;
  for (int i = 0; i < count; ++i) {
    const double angle = 0.3 + 2 * glm::pi<double>() * i / count;
    const glm::dvec3 from(std::cos(angle), std::sin(angle), 0.35);
    views.push_back(look(middle + from * distance, middle, fov_y_degrees, size, near));
  }
  return views;
}

Affine linear(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, const glm::dvec3& at) {
  return Affine(x, y, z, at);
}

Model snapped(Model model, double step) {
  for (Mesh& mesh : model.meshes) {
    for (glm::dvec3& p : mesh.positions) p = glm::round(p / step) * step;
  }
  return model;
}

Model moved(Model model, const glm::dvec3& by) {
  for (Instance& instance : model.instances) instance.transform[3] += by;
  for (GroupInstance& instance : model.group_instances) instance.transform[3] += by;
  return model;
}

std::vector<View> moved(std::vector<View> views, const glm::dvec3& by) {
  for (View& view : views) {
    view.camera.eye += by;
    view.camera.target += by;
  }
  return views;
}

Model scaled(Model model, double factor) {
  for (Instance& instance : model.instances) instance.transform *= factor;
  for (GroupInstance& instance : model.group_instances) instance.transform *= factor;
  return model;
}

std::vector<View> scaled(std::vector<View> views, double factor) {
  for (View& view : views) {
    Camera& camera = view.camera;
    camera.eye *= factor;
    camera.target *= factor;
    camera.near *= factor;
    if (!camera.orthographic()) continue;
    for (double* side : {&camera.left, &camera.right, &camera.bottom, &camera.top}) *side *= factor;
  }
  return views;
}

Model small_house(uint32_t seed) {
  Maker maker;
  maker.box({0, 0, -0.25}, {16, 8, 0}).box({0, 0, 3}, {16, 8, 3.25});
  maker.box({0, 0, 0}, {0.25, 8, 3}).box({15.75, 0, 0}, {16, 8, 3});
  maker.box({0, 0, 0}, {16, 0.25, 3}).box({0, 7.75, 0}, {16, 8, 3});
  maker.box({8, 0, 0}, {8.25, 3, 3}).box({8, 4, 0}, {8.25, 8, 3}).box({8, 3, 2}, {8.25, 4, 3});
  maker.box({12, 0, 0}, {12.25, 8, 3});
  maker.mesh(awkward::sphere(10, 0.75, {4, 4, 1}));
  maker.clutter(60, {0.5, 0.5, 0}, {15, 7, 2}, 0.6, seed);
  return snapped(maker.model(), 0x1p-12);
}

std::vector<View> house_views(Size size) {
  std::vector<View> views;
  for (int i = 0; i < 4; ++i) views.push_back(look({1 + 0.5 * i, 2.5, 1.5}, {12, 4, 1.25}, 60, size));
  for (int i = 0; i < 4; ++i)
    views.push_back(look({9.5, 4, 1.5}, {9.5 + std::cos(1.6 * i), 4 + std::sin(1.6 * i), 1.5}, 75, size));
  return views;
}

Trial house_elsewhere(double scale, const glm::dvec3& by) {
  Trial trial;
  trial.model = moved(scaled(small_house(), scale), by);
  trial.views = moved(scaled(house_views(), scale), by);
  trial.twin = std::make_shared<Trial>();
  trial.twin->model = small_house();
  trial.twin->views = house_views();
  return trial;
}

}  // namespace triptych::hard_cases
