#include "lod/parts.hpp"

#include "base/error.hpp"
#include "base/threads.hpp"
#include "scene/partition.hpp"
#include "scene/weld.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <map>

namespace triptych {

namespace {

constexpr int model_bits = 26, mesh_bits = 21;
/// Beyond it squares of lengths would not be finite.
constexpr double largest_coordinate = 1e100;

bool usable(const Affine& transform) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (!(std::abs(transform[column][row]) < largest_coordinate)) return false;
    }
  }
  const double stretch = largest_stretch(transform);
  return std::abs(glm::determinant(glm::dmat3(transform))) > 1e-12 * stretch * stretch * stretch;
}

/// The box of the positions that triangles use, transformed.
Box box_of(const Mesh& mesh, const Affine& transform) {
  std::vector<uint8_t> used(mesh.positions.size(), 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (const uint32_t vertex : triangle.vertices) used[vertex] = 1;
  }
  Box box;
  for (size_t i = 0; i < used.size(); ++i) {
    if (used[i]) box.extend(transform * glm::dvec4(mesh.positions[i], 1));
  }
  return box;
}

bool finite(const Box& box) {
  const glm::dvec3 furthest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  return std::max({furthest.x, furthest.y, furthest.z}) < largest_coordinate;
}

uint8_t to_srgb(float linear) {
  const double value = std::clamp(static_cast<double>(linear), 0.0, 1.0);
  const double srgb = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  return static_cast<uint8_t>(std::lround(srgb * 255));
}

/// The palette index of each material.
std::vector<uint32_t> make_palette(const std::vector<Material>& materials, Parts& parts) {
  std::map<std::array<uint8_t, 4>, uint32_t> indices;
  std::vector<uint32_t> colors;
  for (const Material& material : materials) {
    const glm::vec4& factor = material.base_color;
    const std::array<uint8_t, 4> color = {
        to_srgb(factor.r), to_srgb(factor.g), to_srgb(factor.b),
        static_cast<uint8_t>(std::lround(std::clamp(factor.a, 0.0f, 1.0f) * 255))};
    const auto [found, inserted] = indices.try_emplace(color, static_cast<uint32_t>(parts.palette.size()));
    if (inserted) parts.palette.push_back(color);
    colors.push_back(found->second);
  }
  return colors;
}

double diagonal(const LatticeBox& box) { return glm::length(glm::dvec3(box.hi) - glm::dvec3(box.lo)); }

struct MeshParts {
  std::vector<Part> parts;
  uint32_t borders = 0;
};

MeshParts divide(Surface surface, uint32_t lattice, const PartitionLimits& limits) {
  MeshParts result;
  const auto groups = partition_triangles(surface, limits);
  if (groups.size() <= 1) {
    if (!surface.triangles.empty()) result.parts.push_back({std::move(surface), {}, lattice});
    return result;
  }
  std::vector<uint32_t> uses(surface.points.size(), 0), numbers(surface.points.size(), no_border);
  std::vector<std::vector<uint32_t>> sources;
  for (const auto& group : groups) {
    std::vector<Triangle> triangles;
    for (const uint32_t index : group) triangles.push_back(surface.triangles[index]);
    Piece piece = extract(surface.points, triangles);
    for (const uint32_t source : piece.sources) ++uses[source];
    result.parts.push_back({std::move(piece.surface), {}, lattice});
    sources.push_back(std::move(piece.sources));
  }
  for (size_t i = 0; i < uses.size(); ++i) {
    if (uses[i] > 1) numbers[i] = result.borders++;
  }
  for (size_t i = 0; i < sources.size(); ++i) {
    for (const uint32_t source : sources[i]) result.parts[i].borders.push_back(numbers[source]);
  }
  return result;
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

LatticeBox placed_box(const Parts& parts, const PlacedPart& placed) {
  const Part& part = parts.parts[placed.part];
  if (placed.transform == 0) return part.surface.box();
  const Lattice& lattice = parts.lattices[part.lattice];
  const Affine& transform = parts.transforms[placed.transform];
  Box box;
  for (const glm::ivec3& point : part.surface.points)
    box.extend(transform * glm::dvec4(lattice.position(point), 1));
  LatticeBox enclosing = parts.lattices[0].enclosing(box);
  enclosing.lo -= 1;  // rounding in the transform
  enclosing.hi += 1;
  return enclosing;
}

Parts make_parts(Model& model, const BuildOptions& options, ImportReport& report) {
  Parts parts;
  const std::vector<uint32_t> colors = make_palette(model.materials, parts);
  const Affine identity(1);

  // Which instances count, and how often each mesh is placed by them.
  std::vector<Box> mesh_boxes(model.meshes.size()), instance_boxes(model.instances.size());
  parallel_for(model.meshes.size(), [&](size_t i) { mesh_boxes[i] = box_of(model.meshes[i], identity); });
  std::vector<uint32_t> uses(model.meshes.size(), 0);
  std::vector<uint32_t> placed;
  uint64_t bad_transforms = 0;
  for (uint32_t i = 0; i < model.instances.size(); ++i) {
    const Instance& instance = model.instances[i];
    if (mesh_boxes[instance.mesh].empty()) continue;
    if (!usable(instance.transform) || !finite(mesh_boxes[instance.mesh])) {
      ++bad_transforms;
    } else {
      ++uses[instance.mesh];
      placed.push_back(i);
    }
  }
  if (bad_transforms > 0) {
    report.warnings.push_back(std::to_string(bad_transforms) +
                              " placements left out: their transforms are singular or beyond all bounds");
  }
  if (placed.empty()) fail("model", "holds no triangles");

  // Meshes that are placed more than once: a lattice each, welded in mesh space.
  parts.lattices.resize(1);
  std::vector<uint32_t> lattice_of(model.meshes.size(), 0);
  for (size_t i = 0; i < model.meshes.size(); ++i) {
    if (uses[i] < 2) continue;
    lattice_of[i] = static_cast<uint32_t>(parts.lattices.size());
    parts.lattices.push_back(make_lattice(mesh_boxes[i], mesh_bits));
  }
  std::vector<Welded> welded(model.meshes.size());
  parallel_for(model.meshes.size(), [&](size_t i) {
    if (uses[i] < 2) return;
    welded[i] = weld(model.meshes[i], identity, parts.lattices[lattice_of[i]], colors);
    model.meshes[i] = {};
  });

  // The model's box and lattice; then the meshes that are placed once, baked.
  parallel_for(placed.size(), [&](size_t i) {
    const Instance& instance = model.instances[placed[i]];
    Box& box = instance_boxes[placed[i]];
    if (uses[instance.mesh] < 2) {
      box = box_of(model.meshes[instance.mesh], instance.transform);
    } else {
      const Lattice& lattice = parts.lattices[lattice_of[instance.mesh]];
      for (const glm::ivec3& point : welded[instance.mesh].surface.points) {
        box.extend(instance.transform * glm::dvec4(lattice.position(point), 1));
      }
    }
  });
  Box model_box;
  for (const uint32_t i : placed) model_box.extend(instance_boxes[i]);
  if (model_box.empty()) fail("model", "holds no triangles");
  parts.lattices[0] = make_lattice(model_box, model_bits);
  parallel_for(placed.size(), [&](size_t i) {
    const Instance& instance = model.instances[placed[i]];
    if (uses[instance.mesh] != 1) return;
    welded[instance.mesh] = weld(model.meshes[instance.mesh], instance.transform, parts.lattices[0], colors);
    model.meshes[instance.mesh] = {};
  });

  // The first partition, once a mesh. Borders between parts stay as they are in all levels, and that costs
  // triangles: a mesh that is small in the model, such as a piece of furniture, is parted only if it has a
  // great many.
  const double model_diagonal = glm::length(model_box.hi - model_box.lo);
  const double small = model_diagonal / 32, large = model_diagonal / 6;
  std::vector<double> stretches(model.meshes.size(), 0);
  for (const uint32_t i : placed) {
    const Instance& instance = model.instances[i];
    const double stretch = uses[instance.mesh] < 2 ? 1 : largest_stretch(instance.transform);
    stretches[instance.mesh] = std::max(stretches[instance.mesh], stretch);
  }
  std::vector<MeshParts> divided(model.meshes.size());
  parallel_for(model.meshes.size(), [&](size_t i) {
    if (uses[i] == 0) return;
    PartitionLimits limits;
    const double scale = stretches[i] * parts.lattices[lattice_of[i]].step;
    limits.triangles = options.part_triangles;
    if (diagonal(welded[i].surface.box()) * scale < small &&
        welded[i].surface.triangles.size() <= size_t{options.part_triangles} * 8) {
      limits.triangles = welded[i].surface.triangles.size();
    }
    limits.diagonal = large / scale;
    divided[i] = divide(std::move(welded[i].surface), lattice_of[i], limits);
  });

  std::vector<uint32_t> first_part(model.meshes.size(), 0), part_count(model.meshes.size(), 0);
  for (size_t i = 0; i < model.meshes.size(); ++i) {
    report.dropped_triangles += welded[i].dropped_triangles;
    report.welded_vertices += welded[i].welded_vertices;
    first_part[i] = static_cast<uint32_t>(parts.parts.size());
    part_count[i] = static_cast<uint32_t>(divided[i].parts.size());
    std::move(divided[i].parts.begin(), divided[i].parts.end(), std::back_inserter(parts.parts));
  }
  parts.transforms.push_back(identity);
  parts.stretches.push_back(1);
  for (const uint32_t i : placed) {
    const Instance& instance = model.instances[i];
    uint32_t transform = 0;
    if (uses[instance.mesh] > 1) {
      transform = static_cast<uint32_t>(parts.transforms.size());
      parts.transforms.push_back(instance.transform);
      parts.stretches.push_back(largest_stretch(instance.transform));
    }
    const auto number = static_cast<uint32_t>(parts.border_counts.size());
    parts.border_counts.push_back(divided[instance.mesh].borders);
    for (uint32_t part = 0; part < part_count[instance.mesh]; ++part) {
      parts.placed.push_back({first_part[instance.mesh] + part, transform, number});
    }
  }
  parts.instances = placed.size();
  if (parts.placed.empty()) fail("model", "holds no triangle that has an area");
  return parts;
}

}  // namespace triptych
