#include "fuzz_target.hpp"

#include "base/error.hpp"

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <sys/mman.h>
#include <unistd.h>
#include <vector>

namespace triptych::fuzz {

namespace {

void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz target: %s\n", what);
  std::abort();
}

/// The placed triangles by their corners; nothing where the import or the reading is an Error.
std::optional<std::vector<CornerTriangle>> triangles_of(const std::filesystem::path& file,
                                                        void (*import)(FileImport&),
                                                        const ImportOptions& options) {
  std::vector<CornerTriangle> triangles;
  try {
    Model model;
    model.materials.emplace_back();
    FileImport target(file, model, options);
    import(target);
    target.finish();
    for (const Mesh& mesh : model.meshes) {
      if (mesh.stream) {
        mesh.stream->read([&](std::span<const CornerTriangle> batch) {
          triangles.insert(triangles.end(), batch.begin(), batch.end());
        });
      }
      for (const Triangle& triangle : mesh.triangles) {
        CornerTriangle corners{{}, triangle.material};
        for (size_t k = 0; k < 3; ++k) {
          expect(triangle.vertices[k] < mesh.positions.size(), "an index is out of range");
          corners.corners[k] = mesh.positions[triangle.vertices[k]];
          if (!mesh.normals.empty()) {
            expect(mesh.normals.size() == mesh.positions.size(), "normals are not those of the vertices");
            corners.normals[k] = mesh.normals[triangle.vertices[k]];
          }
          if (!mesh.coordinates.empty()) {
            expect(mesh.coordinates.size() == mesh.positions.size(),
                   "coordinates are not those of the vertices");
            corners.coordinates[k] = mesh.coordinates[triangle.vertices[k]];
          }
          if (mesh.colors.empty()) continue;
          expect(mesh.colors.size() == mesh.positions.size(), "colours are not those of the vertices");
          corners.colors[k] = mesh.colors[triangle.vertices[k]];
        }
        triangles.push_back(corners);
      }
    }
    for (const Instance& instance : model.instances)
      expect(instance.mesh < model.meshes.size(), "an instance names no mesh");
    for (const GroupInstance& instance : model.group_instances)
      expect(instance.group < model.groups.size(), "a group's instance names none");
    for (size_t i = 0; i < model.groups.size(); ++i) {
      for (const Instance& instance : model.groups[i].instances)
        expect(instance.mesh < model.meshes.size(), "an instance in a group names no mesh");
      for (const GroupInstance& instance : model.groups[i].groups)
        expect(instance.group < i, "a group holds one that does not come before it");
    }
    for (const CornerTriangle& triangle : triangles) {
      expect(triangle.material < model.materials.size(), "a triangle names no material");
      for (const glm::dvec3& corner : triangle.corners)
        expect(is_usable(corner), "a coordinate is not finite");
    }
  } catch (const Error& error) {
    expect(std::string(error.what()).find('\n') == std::string::npos, "an error has several lines");
    return std::nullopt;
  }
  return triangles;
}

}  // namespace

std::filesystem::path file_of(std::span<const uint8_t> bytes) {
  static const int descriptor = ::memfd_create("fuzz", 0);
  expect(descriptor >= 0 && ::ftruncate(descriptor, 0) == 0, "there is no file in memory");
  expect(::pwrite(descriptor, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()),
         "the file in memory cannot be written");
  return "/proc/self/fd/" + std::to_string(descriptor);
}

void import_both_ways(std::span<const uint8_t> bytes, void (*import)(FileImport&)) {
  const std::filesystem::path file = file_of(bytes);
  ImportOptions in_memory;
  in_memory.group_placements = in_memory.group_triangles = 1;
  in_memory.max_placements = 1000;
  ImportOptions streamed = in_memory;
  in_memory.stream_above = in_memory.max_in_memory = uint64_t{1} << 40;
  streamed.stream_above = streamed.max_in_memory = 0;
  const auto expected = triangles_of(file, import, in_memory);
  const auto found = triangles_of(file, import, streamed);
  // A stream may do without parts of a file that hold no geometry, so it may succeed alone.
  if (!expected) return;
  expect(found.has_value(), "the file is read in memory but not as a stream");
  expect(*found == *expected, "a stream holds other triangles than the mesh in memory");
}

}  // namespace triptych::fuzz
