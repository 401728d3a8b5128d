#include "tests/support/pack_judge.hpp"

#include "model/flatten.hpp"
#include "tests/support/drawable_triangles.hpp"
#include "tests/support/surface_judge.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace triptych::judge {

namespace {

std::vector<Corners> placed_triangles(const Model& model) {
  std::vector<Corners> result;
  const Model flat = flattened(model);
  for (const Instance& instance : flat.instances) {
    const Mesh& mesh = model.meshes.at(instance.mesh);
    for (const Triangle& triangle : mesh.triangles) {
      Corners corners;
      for (size_t i = 0; i < 3; ++i) {
        corners[i] = instance.transform * glm::dvec4(mesh.positions.at(triangle.vertices[i]), 1);
      }
      result.push_back(corners);
    }
  }
  return result;
}

double area(const Corners& t) { return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2; }

/// How far the corners are from those of the other triangle, whichever stands for which.
double mismatch(const Corners& a, const Corners& b) {
  double least = std::numeric_limits<double>::infinity();
  std::array<size_t, 3> order = {0, 1, 2};
  do {
    double worst = 0;
    for (size_t i = 0; i < 3; ++i) worst = std::max(worst, glm::distance(a[i], b[order[i]]));
    least = std::min(least, worst);
  } while (std::next_permutation(order.begin(), order.end()));
  return least;
}

/// For each scene node the model's triangles below it.
class Sources {
 public:
  Sources(const Pack& pack, const Model& model) : source_(placed_triangles(model)) {
    const Skeleton& skeleton = pack.skeleton();
    std::vector<Corners> finest;
    std::vector<SceneNodeId> owners;
    for (SceneNodeId id = 0; id < skeleton.scene_nodes.size(); ++id) {
      const SceneNode& node = skeleton.scene_nodes[id];
      if (node.child_count > 0) continue;
      for (const Corners& corners : triangles_of(pack, node.first_drawable)) {
        finest.push_back(corners);
        owners.push_back(id);
      }
    }
    below_.resize(skeleton.scene_nodes.size());
    const NearestTriangles found(std::move(finest));
    for (uint32_t i = 0; i < source_.size(); ++i) {
      bool matched = false;
      double radius = 0;
      for (const SceneNode& node : skeleton.scene_nodes) {
        if (node.child_count == 0) radius = std::max(radius, skeleton.drawables[node.first_drawable].error);
      }
      found.near(source_[i][0], radius, [&](size_t candidate) {
        const SceneNodeId owner = owners[candidate];
        const double error = skeleton.drawables[skeleton.scene_nodes[owner].first_drawable].error;
        if (mismatch(source_[i], found.triangles()[candidate]) > error * (1 + 1e-6) + 1e-300) return;
        matched = true;
        if (below_[owner].empty() || below_[owner].back() != i) below_[owner].push_back(i);
      });
      if (!matched && area(source_[i]) > 1e-14 * std::pow(glm::distance(source_[i][0], source_[i][1]) +
                                                              glm::distance(source_[i][0], source_[i][2]),
                                                          2))
        ++missing;
    }
    for (size_t id = below_.size(); id-- > 1;) {
      auto& parent = below_[skeleton.scene_nodes[id].parent];
      parent.insert(parent.end(), below_[id].begin(), below_[id].end());
    }
  }

  std::vector<Corners> of(SceneNodeId id) const {
    std::vector<Corners> result;
    for (const uint32_t triangle : below_[id]) result.push_back(source_[triangle]);
    return result;
  }

  uint64_t missing = 0;

 private:
  std::vector<Corners> source_;
  std::vector<std::vector<uint32_t>> below_;
};

}  // namespace

Verdict judge_pack(const Pack& pack, const Model& model, size_t every, int steps) {
  const Skeleton& skeleton = pack.skeleton();
  const Sources sources(pack, model);
  const Box box = skeleton.lattice().box(skeleton.scene_nodes[0].box);
  const double rounding = 0x1p-49 * std::max(glm::length(box.lo), glm::length(box.hi));
  Verdict verdict;
  verdict.missing = sources.missing;
  for (SceneNodeId id = 0; id < skeleton.scene_nodes.size(); ++id) {
    const SceneNode& node = skeleton.scene_nodes[id];
    const std::vector<Corners> source = sources.of(id);
    if (source.empty()) {
      verdict.lies.push_back(fmt::format("scene node {} shows nothing of the model", id));
      continue;
    }
    const NearestTriangles to_source(source);
    for (DrawableId own = node.first_drawable; own < node.first_drawable + node.drawable_count; ++own) {
      if (own % every != 0 && id > 0) continue;
      const NearestTriangles drawn(triangles_of(pack, own));
      const double there = furthest(drawn.triangles(), to_source, steps),
                   back = furthest(source, drawn, steps);
      const double error = skeleton.drawables[own].error, measured = std::max(there, back);
      ++verdict.drawables;
      if (measured > error * (1 + 1e-9) + rounding) {
        verdict.lies.push_back(
            fmt::format("drawable {} of {} triangles: {} from its source, {} back, and says {}", own,
                        drawn.triangles().size(), there, back, error));
      }
      const bool simplified = node.child_count > 0 || own > node.first_drawable;
      if (simplified && error > 0) verdict.closest = std::max(verdict.closest, measured / error);
    }
  }
  return verdict;
}

}  // namespace triptych::judge
