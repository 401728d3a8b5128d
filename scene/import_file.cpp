#include "scene/import_file.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace triptych {

namespace {

bool usable(const glm::dvec3& position) {
  // Written so that NaN is not usable.
  return std::abs(position.x) <= largest_coordinate && std::abs(position.y) <= largest_coordinate &&
         std::abs(position.z) <= largest_coordinate;
}

/// Drops triangles with unusable coordinates, then the vertices that nothing uses any more. Returns how many
/// triangles.
uint64_t drop_unusable(Mesh& mesh) {
  if (std::all_of(mesh.positions.begin(), mesh.positions.end(), usable)) return 0;
  const auto dropped = std::erase_if(mesh.triangles, [&](const Triangle& triangle) {
    return !std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                        [&](uint32_t vertex) { return usable(mesh.positions[vertex]); });
  });
  std::vector<uint32_t> renamed(mesh.positions.size());
  uint32_t kept = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!usable(mesh.positions[i])) continue;
    mesh.positions[kept] = mesh.positions[i];
    renamed[i] = kept++;
  }
  mesh.positions.resize(kept);
  for (Triangle& triangle : mesh.triangles) {
    for (uint32_t& vertex : triangle.vertices) vertex = renamed[vertex];
  }
  return dropped;
}

}  // namespace

FileImport::FileImport(std::filesystem::path file, Model& model)
    : file_(std::move(file)), model_(model), first_instance_(model.instances.size()) {}

std::string FileImport::line_place(uint64_t line) const { return fmt::format("{}: line {}", place(), line); }

void FileImport::warn(std::string_view what, uint64_t count) {
  if (count == 0) return;
  const auto known = std::find_if(warnings_.begin(), warnings_.end(),
                                  [&](const auto& warning) { return warning.first == what; });
  if (known != warnings_.end()) {
    known->second += count;
  } else {
    warnings_.emplace_back(what, count);
  }
}

uint32_t FileImport::add_material(const Material& material) {
  model_.materials.push_back(material);
  return static_cast<uint32_t>(model_.materials.size() - 1);
}

std::optional<uint32_t> FileImport::add_mesh(Mesh mesh) {
  const uint64_t dropped = drop_unusable(mesh);
  model_.report.dropped_triangles += dropped;
  warn("triangles were dropped: their coordinates are not finite", dropped);
  if (mesh.triangles.empty()) return std::nullopt;
  if (model_.meshes.size() == std::numeric_limits<uint32_t>::max()) fail(place(), "holds too many meshes");
  model_.meshes.push_back(std::move(mesh));
  return static_cast<uint32_t>(model_.meshes.size() - 1);
}

void FileImport::add_instance(uint32_t mesh, const Affine& transform) {
  model_.instances.push_back({mesh, transform});
}

void FileImport::finish() {
  for (const auto& [what, count] : warnings_) {
    model_.report.warnings.push_back(fmt::format("{}: {} {}", place(), count, what));
  }
  if (model_.instances.size() == first_instance_) fail(place(), "holds no triangles");
}

}  // namespace triptych
