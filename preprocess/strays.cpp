#include "preprocess/strays.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numeric>

namespace triptych {

namespace {

constexpr double trimmed = 0.01;  ///< of the triangles, at both ends of each axis
constexpr double far = 100;       ///< diagonals of the body

/// Where, along an axis, centres lie when a hundredth of the triangles are left out at both ends.
std::pair<double, double> middle_of(std::span<const ObjectExtent> objects, int axis) {
  std::vector<std::pair<double, double>> centres;
  double sum = 0;
  for (const ObjectExtent& object : objects) {
    centres.emplace_back(center(object.box)[axis], static_cast<double>(object.triangles));
    sum += centres.back().second;
  }
  std::sort(centres.begin(), centres.end());
  const auto reach = [&](double share) {
    double passed = 0;
    for (const auto& [centre, triangles] : centres) {
      passed += triangles;
      if (passed > sum * share) return centre;
    }
    return centres.back().first;
  };
  return {reach(trimmed), reach(1 - trimmed)};
}

/// Of each hierarchy what is placed in it. Doubles: groups of groups multiply.
std::vector<double> triangles_of_hierarchies(const BuildPlan& plan) {
  std::vector<double> sums(plan.hierarchies.size());
  for (const PlannedInstance& instance : plan.instances)
    sums[instance.hierarchy] += static_cast<double>(plan.meshes[instance.mesh].triangles);
  for (size_t i = 0; i < sums.size(); ++i) {  // a hierarchy comes after those that it places
    for (const PlannedSubHierarchy& inner : plan.hierarchies[i].sub_hierarchies)
      sums[i] += sums[inner.hierarchy];
  }
  return sums;
}

}  // namespace

Box body_of(std::span<const ObjectExtent> objects) {
  Box body;
  if (objects.empty()) return body;
  std::pair<double, double> middles[3];
  for (int axis = 0; axis < 3; ++axis) middles[axis] = middle_of(objects, axis);
  for (const ObjectExtent& object : objects) {
    const glm::dvec3 centre = center(object.box);
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
      within = within && centre[axis] >= middles[axis].first && centre[axis] <= middles[axis].second;
    if (within) body.extend(object.box);
  }
  return body;
}

double distance_of(const Box& a, const Box& b) {
  return glm::length(glm::max(glm::max(a.lo - b.hi, b.lo - a.hi), 0.0));
}

std::vector<uint32_t> strays(std::span<const ObjectExtent> objects) {
  const Box body = body_of(objects);
  std::vector<uint32_t> found;
  if (body.empty() || !(diagonal(body) > 0)) return found;
  const double limit = far * diagonal(body);
  for (uint32_t i = 0; i < objects.size(); ++i) {
    if (distance_of(objects[i].box, body) > limit) found.push_back(i);
  }
  std::stable_sort(found.begin(), found.end(), [&](uint32_t a, uint32_t b) {
    return distance_of(objects[a].box, body) > distance_of(objects[b].box, body);
  });
  return found;
}

std::optional<std::string> stray_warning(const Model& model, const BuildPlan& plan) {
  const auto whole = static_cast<uint32_t>(plan.hierarchies.size() - 1);
  const PlannedHierarchy& hierarchy = plan.hierarchies[whole];
  std::vector<ObjectExtent> objects;
  std::vector<uint32_t> meshes;  // of the model; no_id for groups
  const auto add = [&](const Box& box, uint32_t transform, double triangles, uint32_t mesh) {
    if (box.empty()) return;
    constexpr double most = 0x1p62;
    objects.push_back({.box = placed_box(hierarchy.transforms[transform], box),
                       .triangles = static_cast<uint64_t>(std::min(triangles, most))});
    meshes.push_back(mesh);
  };
  for (const PlannedInstance& instance : plan.instances) {
    const PlannedMesh& mesh = plan.meshes[instance.mesh];
    if (instance.hierarchy == whole)
      add(mesh.box, instance.transform, static_cast<double>(mesh.triangles), mesh.mesh);
  }
  const std::vector<double> triangles = triangles_of_hierarchies(plan);
  for (const PlannedSubHierarchy& inner : hierarchy.sub_hierarchies)
    add(plan.hierarchies[inner.hierarchy].box, inner.transform, triangles[inner.hierarchy], no_id);
  const std::vector<uint32_t> found = strays(objects);
  if (found.empty()) return std::nullopt;
  const Box body = body_of(objects);
  const uint32_t mesh = meshes[found[0]];
  const std::string name = mesh == no_id ? "a group" : fmt::format("\"{}\"", model.meshes[mesh].name);
  return fmt::format(
      "{} of {} objects lie far from the others: {} is {:.6g} units away from them, who fill {:.6g}; if "
      "that is a "
      "slip, mend it in the model: it costs precision",
      found.size(), objects.size(), name, distance_of(objects[found[0]].box, body), diagonal(body));
}

}  // namespace triptych
