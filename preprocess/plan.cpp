#include "preprocess/plan.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/threads.hpp"
#include "model/read_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>
#include <glm/glm.hpp>
#include <map>

namespace triptych {

namespace {

constexpr int model_bits = 26, mesh_bits = 21;
/// Between them products of six lengths are finite and, down to a lattice step, do not vanish.
constexpr double largest_coordinate = 1e50, least_extent = 1e-40;

bool finite(const Affine& transform) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (!(std::abs(transform[column][row]) < largest_coordinate)) return false;
    }
  }
  return true;
}

/// Whether floats can place a mesh under it to within a small multiple of their own precision: the product of
/// the matrix's absolute values and its inverse's is bounded (Skeel, Scaling for numerical stability, 1979).
/// Turned and stretched meshes are near 1; shears and what flattens a mesh are far above.
bool well_conditioned(const Affine& transform, double largest_condition) {
  // Far beyond all units there are, the mesh as it was made may be too small or too large to be measured.
  constexpr double largest_change = 1e20;
  const double stretch = largest_stretch(transform);
  if (!(stretch > 1 / largest_change && stretch < largest_change)) return false;
  const glm::dmat3 matrix(transform), inverse = glm::inverse(matrix);
  double sum = 0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      double entry = 0;
      for (int k = 0; k < 3; ++k) entry += std::abs(matrix[k][row]) * std::abs(inverse[column][k]);
      sum += entry * entry;
    }
  }
  // Written so that NaN is not well-conditioned. The identity's is √3.
  return sum <= largest_condition * largest_condition;
}

bool finite(const Box& box) {
  const glm::dvec3 furthest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  return std::max({furthest.x, furthest.y, furthest.z}) < largest_coordinate;
}

/// Of the positions that triangles use, transformed.
Box box_of(const Mesh& mesh, const Affine& transform) {
  Box box;
  read_mesh(mesh, [&](std::span<const CornerTriangle> batch) {
    for (const CornerTriangle& triangle : batch) {
      for (const glm::dvec3& corner : triangle.corners) box.extend(transform * glm::dvec4(corner, 1));
    }
  });
  return box;
}

uint8_t to_srgb(float linear) {
  const double value = std::clamp(static_cast<double>(linear), 0.0, 1.0);
  const double srgb = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  return static_cast<uint8_t>(std::lround(srgb * 255));
}

void make_palette(const std::vector<Material>& materials, BuildPlan& plan) {
  std::map<std::array<uint8_t, 4>, uint32_t> indices;
  for (const Material& material : materials) {
    const glm::vec4& factor = material.base_color;
    const std::array<uint8_t, 4> color = {
        to_srgb(factor.r), to_srgb(factor.g), to_srgb(factor.b),
        static_cast<uint8_t>(std::lround(std::clamp(factor.a, 0.0f, 1.0f) * 255))};
    const auto [found, inserted] = indices.try_emplace(color, static_cast<uint32_t>(plan.palette.size()));
    if (inserted) plan.palette.push_back(color);
    if (plan.palette.size() > most_colors) fail("build", "the model has more than {} colours", most_colors);
    plan.colors.push_back(found->second);
  }
}

/// Placements of meshes that hold triangles, under transforms that can be drawn; how often each mesh is
/// placed so that it can be shared.
std::vector<uint32_t> usable_instances(const Model& model, const BuildRules& rules, BuildPlan& plan,
                                       std::vector<uint32_t>& uses) {
  std::vector<uint32_t> placed;
  for (uint32_t i = 0; i < model.instances.size(); ++i) {
    const Instance& instance = model.instances[i];
    if (model.meshes[instance.mesh].triangle_count() == 0) continue;
    if (finite(instance.transform)) {
      if (well_conditioned(instance.transform, rules.largest_condition)) ++uses[instance.mesh];
      placed.push_back(i);
    } else {
      ++plan.left_out;
    }
  }
  return placed;
}

}  // namespace

double largest_stretch(const Affine& transform) {
  // The largest eigenvalue of MᵀM, by Jacobi rotations.
  const glm::dmat3 matrix(transform);
  glm::dmat3 gram = glm::transpose(matrix) * matrix;
  for (int sweep = 0; sweep < 30; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (gram[p][q] == 0) continue;
        const double angle = 0.5 * std::atan2(2 * gram[p][q], gram[q][q] - gram[p][p]);
        glm::dmat3 rotation(1);
        rotation[p][p] = rotation[q][q] = std::cos(angle);
        rotation[q][p] = std::sin(angle);
        rotation[p][q] = -std::sin(angle);
        gram = glm::transpose(rotation) * gram * rotation;
      }
    }
  }
  return std::sqrt(std::max({gram[0][0], gram[1][1], gram[2][2], 0.0})) * (1 + 1e-12);
}

BuildPlan make_plan(const Model& model, const BuildOptions& options) {
  BuildPlan plan;
  make_palette(model.materials, plan);
  plan.transforms.push_back(Affine(1));
  plan.stretches.push_back(1);
  plan.lattices.resize(1);
  std::vector<uint32_t> uses(model.meshes.size(), 0);
  const std::vector<uint32_t> placed = usable_instances(model, options.rules, plan, uses);

  constexpr uint32_t none = 0xffffffffu;
  std::vector<uint32_t> shared(model.meshes.size(), none);  // the planned mesh of all placements
  for (const uint32_t index : placed) {
    const Instance& instance = model.instances[index];
    PlannedInstance planned;
    if (options.share_instances && uses[instance.mesh] > 1 &&
        well_conditioned(instance.transform, options.rules.largest_condition)) {
      planned.transform = static_cast<uint32_t>(plan.transforms.size());
      plan.transforms.push_back(instance.transform);
      plan.stretches.push_back(options.rules.bounds_are_stretched ? largest_stretch(instance.transform) : 1);
      if (shared[instance.mesh] == none) {
        shared[instance.mesh] = static_cast<uint32_t>(plan.meshes.size());
        plan.meshes.push_back({instance.mesh, none, Affine(1), {}, 0, {}, 0});
      }
      planned.mesh = shared[instance.mesh];
    } else {
      planned.mesh = static_cast<uint32_t>(plan.meshes.size());
      plan.meshes.push_back({instance.mesh, 0, instance.transform, {}, 1, {}, 0});
    }
    PlannedMesh& mesh = plan.meshes[planned.mesh];
    mesh.triangles = model.meshes[instance.mesh].triangle_count();
    mesh.stretch = std::max(mesh.stretch, plan.stretches[planned.transform]);
    mesh.instances.push_back(static_cast<uint32_t>(plan.instances.size()));
    plan.instances.push_back(planned);
  }

  Progress progress("measuring meshes", plan.meshes.size());
  parallel_for(plan.meshes.size(), [&](size_t i) {
    PlannedMesh& mesh = plan.meshes[i];
    mesh.box = box_of(model.meshes[mesh.mesh], mesh.transform);
    progress.advance();
  });
  for (const Mesh& mesh : model.meshes) {
    if (!mesh.stream) continue;
    const std::vector<std::string> warnings = mesh.stream->warnings();
    plan.warnings.insert(plan.warnings.end(), warnings.begin(), warnings.end());
  }
  for (PlannedMesh& mesh : plan.meshes) {
    if (mesh.box.empty()) plan.dropped_triangles += mesh.triangles;
    if (!mesh.box.empty() && !finite(mesh.box)) {
      plan.left_out += mesh.instances.size();
      mesh.box = {};
    }
    if (mesh.box.empty()) {
      mesh.triangles = 0;  // its placements stay in the plan, and place nothing
      continue;
    }
    for (const uint32_t instance : mesh.instances) {
      const Affine& transform = plan.transforms[plan.instances[instance].transform];
      for (int corner = 0; corner < 8; ++corner)
        plan.box.extend(transform * glm::dvec4(mesh.box.corner(corner), 1));
    }
    if (mesh.lattice == 0) continue;
    mesh.lattice = static_cast<uint32_t>(plan.lattices.size());
    plan.lattices.push_back(make_lattice(mesh.box, mesh_bits));
  }
  if (plan.box.empty()) {
    fail(model.name(), "holds no triangles{}{}", plan.warnings.empty() ? "" : ": ",
         fmt::join(plan.warnings, "; "));
  }
  const double extent = diagonal(plan.box);
  if (extent < least_extent)
    fail(model.name(), "is {} units large, which is less than numbers bear: give it other units", extent);
  plan.lattices[0] = make_lattice(plan.box, model_bits);
  return plan;
}

}  // namespace triptych
