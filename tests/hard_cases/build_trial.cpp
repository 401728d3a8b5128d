// Builds against the model as it was given, not as it lies on its lattices.
#include "model/flatten.hpp"
#include "preprocess/check/check.hpp"
#include "tests/hard_cases/trials.hpp"
#include "tests/support/distance_judge.hpp"
#include "tests/support/drawable_triangles.hpp"

#include <fmt/core.h>
#include <glm/matrix.hpp>

namespace triptych::hard_cases {

namespace {

using judge::Corners, judge::triangles_of;

bool finite(const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// The model's triangles where they are placed, up to so many, without those that have no area: their points
/// belong to neighbours.
std::vector<Corners> placed_triangles(const Model& model, size_t most) {
  std::vector<Corners> result;
  for (const Instance& instance : model.instances) {  // of a model without groups
    for (const Triangle& triangle : model.meshes[instance.mesh].triangles) {
      Corners corners;
      for (size_t i = 0; i < 3; ++i) {
        corners[i] =
            instance.transform * glm::dvec4(model.meshes[instance.mesh].positions[triangle.vertices[i]], 1);
      }
      if (!finite(corners[0]) || glm::length(corners[0]) > 1e50) continue;
      if (!result.empty() && result.back() == corners) continue;  // tells nothing new
      if (result.size() == most) return {};
      result.push_back(corners);
    }
  }
  return result;
}

/// To a triangle that may have no area.
double distance_to(const glm::dvec3& p, const Corners& t) {
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &a = t[i], &b = t[(i + 1) % 3];
    nearest = std::min(nearest, a == b ? glm::distance(p, a) : judge::distance_to_segment(p, a, b));
  }
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double inside = judge::distance_to_triangle(p, t);
  return glm::length(normal) > 0 && std::isfinite(inside) ? std::min(nearest, inside) : nearest;
}

double distance_to(const glm::dvec3& p, const std::vector<Corners>& triangles) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Corners& t : triangles) nearest = std::min(nearest, distance_to(p, t));
  return nearest;
}

/// Samples of a drawable's surface must lie within its error of the source.
void hold_against_source(const Pack& pack, const std::vector<Corners>& source, Problems& problems) {
  const Skeleton& skeleton = pack.skeleton();
  const Box box = skeleton.lattice().box(skeleton.scene_nodes[0].box);
  const double rounding = 0x1p-50 * std::max(glm::length(box.lo), glm::length(box.hi));
  for (DrawableId id = 0; id < skeleton.drawables.size() && problems.size() < 5; ++id) {
    const std::vector<Corners> triangles = triangles_of(pack, id);
    const size_t step = triangles.size() / 12 + 1;
    for (size_t i = 0; i < triangles.size(); i += step) {
      const double error = skeleton.drawables[id].error * (1 + 1e-9) + rounding;
      const double distance = std::max(distance_to(triangles[i][0], source),
                                       distance_to((triangles[i][0] + triangles[i][1]) * 0.5, source));
      if (distance <= error) continue;
      problems.push_back(
          fmt::format("drawable {} is {} from the model, its error says {}", id, distance, error));
      break;
    }
  }
}

double volume(const std::vector<Corners>& triangles) {
  double sum = 0;
  for (const Corners& t : triangles) sum += glm::dot(t[0], glm::cross(t[1], t[2])) / 6;
  return sum;
}

}  // namespace

Problems build_problems(const Trial& trial) {
  Problems problems;
  const BuiltTrial built(trial);
  const Skeleton& skeleton = built.pack().skeleton();
  const CheckReport report = check_pack(built.pack(), {.points = 300'000, .messages = 3});
  if (!report.sound()) {
    problems.push_back(fmt::format(
        "{} bound, {} box, {} monotonicity, {} outward, {} seen violations, {} checksum errors: {}",
        report.bound_violations, report.box_violations, report.monotonicity_violations,
        report.outward_violations, report.seen_violations, report.checksum_errors,
        report.messages.empty() ? "" : report.messages[0]));
  }
  const Model flat = flattened(trial.model);
  const std::vector<Corners> source = placed_triangles(flat, 12'000);
  if (!source.empty()) hold_against_source(built.pack(), source, problems);
  if (trial.oriented) {
    const SceneNode& root = skeleton.scene_nodes[0];
    const double coarse = volume(triangles_of(built.pack(), root.first_drawable + root.drawable_count - 1));
    double whole = 0;
    for (const Instance& instance : flat.instances) {
      Model one = flat;
      one.instances = {instance};
      whole += std::abs(volume(placed_triangles(one, 12'000)));
    }
    if (!(coarse > whole * 0.5)) {  // positive where outsides are out
      problems.push_back(fmt::format(
          "a closed model of volume {} is one of {} at the root: parts are turned over", whole, coarse));
    }
  }
  const std::string left_out = fmt::format("{} placements left out", trial.left_out);
  bool said = false;
  for (const std::string& warning : built.report().import.warnings)
    said = said || warning.starts_with(left_out);
  if (skeleton.drawables.size() > trial.max_drawables)
    problems.push_back(fmt::format("{} drawables", skeleton.drawables.size()));
  if (trial.left_out > 0 && !said) problems.push_back("the build does not say \"" + left_out + "\"");
  return problems;
}

}  // namespace triptych::hard_cases
