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
  std::vector<std::pair<double, uint64_t>> centres;
  uint64_t sum = 0;
  for (const ObjectExtent& object : objects) {
    centres.emplace_back(center(object.box)[axis], object.triangles);
    sum += object.triangles;
  }
  std::sort(centres.begin(), centres.end());
  const auto reach = [&](double share) {
    const auto wanted = static_cast<double>(sum) * share;
    double passed = 0;
    for (const auto& [centre, triangles] : centres) {
      passed += static_cast<double>(triangles);
      if (passed > wanted) return centre;
    }
    return centres.back().first;
  };
  return {reach(trimmed), reach(1 - trimmed)};
}

/// Of what is placed in a hierarchy, once each.
uint64_t triangles_of(const BuildPlan& plan, uint32_t hierarchy, const std::vector<uint64_t>& own) {
  uint64_t sum = own[hierarchy];
  for (const PlannedSubHierarchy& inner : plan.hierarchies[hierarchy].sub_hierarchies)
    sum += triangles_of(plan, inner.hierarchy, own);
  return sum;
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
  std::vector<std::string> names;
  std::vector<uint64_t> own(plan.hierarchies.size());
  const auto add = [&](const Box& box, uint32_t transform, uint64_t triangles, std::string name) {
    if (box.empty()) return;
    ObjectExtent object{.box = {}, .triangles = triangles};
    for (int corner = 0; corner < 8; ++corner)
      object.box.extend(hierarchy.transforms[transform] * glm::dvec4(box.corner(corner), 1));
    objects.push_back(object);
    names.push_back(std::move(name));
  };
  for (const PlannedInstance& instance : plan.instances) {
    const PlannedMesh& mesh = plan.meshes[instance.mesh];
    own[instance.hierarchy] += mesh.triangles;
    if (instance.hierarchy == whole)
      add(mesh.box, instance.transform, mesh.triangles, model.meshes[mesh.mesh].name);
  }
  for (const PlannedSubHierarchy& inner : hierarchy.sub_hierarchies)
    add(plan.hierarchies[inner.hierarchy].box, inner.transform, triangles_of(plan, inner.hierarchy, own),
        "a group");
  const std::vector<uint32_t> found = strays(objects);
  if (found.empty()) return std::nullopt;
  const Box body = body_of(objects);
  const std::string& name = names[found[0]];
  return fmt::format(
      "{} of {} objects lie far from the others: \"{}\" is {:.6g} units away from them, who fill {:.6g}; if "
      "that is a "
      "slip, mend it in the model: it costs precision",
      found.size(), objects.size(), name, distance_of(objects[found[0]].box, body), diagonal(body));
}

}  // namespace triptych
