#include "simplify/meshopt_simplify.hpp"

#include "simplify/key_hash.hpp"

#include <algorithm>
#include <glm/vec3.hpp>
#include <meshoptimizer.h>
#include <tsl/robin_map.h>

namespace triptych {

namespace {

/// The surface as meshoptimizer takes it: a vertex for each point and colour, so that colours are not lost,
/// and lines where they meet are seams.
struct Input {
  struct Vertex {
    uint32_t point, material;
  };
  std::vector<Vertex> vertices;
  std::vector<glm::vec3> positions;  ///< of the vertices, and then of the flags
  std::vector<uint32_t> indices;     ///< of the surface, and then of the flags
};

Input make_input(const Surface& surface, std::span<const uint8_t> locked) {
  Input input;
  tsl::robin_map<uint64_t, uint32_t, KeyHash> places;
  for (const Triangle& triangle : surface.triangles) {
    for (const uint32_t point : triangle.vertices) {
      const auto [found, inserted] = places.try_emplace(uint64_t{triangle.material} << 32 | point,
                                                        static_cast<uint32_t>(input.vertices.size()));
      if (inserted) input.vertices.push_back({point, triangle.material});
      input.indices.push_back(found->second);
    }
  }
  const LatticeBox box = surface.box();
  const glm::dvec3 middle = (glm::dvec3(box.lo) + glm::dvec3(box.hi)) * 0.5;
  for (const Input::Vertex& vertex : input.vertices) {
    input.positions.push_back(glm::vec3(glm::dvec3(surface.points[vertex.point]) - middle));
  }
  if (locked.empty()) return input;
  // meshoptimizer never moves a point where several borders meet: two extra triangles ("flags") make a locked
  // point one. They are as large as the surface, so that collapsing them is not cheap.
  const auto size = glm::vec3(glm::dvec3(box.hi) - glm::dvec3(box.lo) + 1.0);
  for (uint32_t i = 0; i < input.vertices.size(); ++i) {
    if (!locked[input.vertices[i].point]) continue;
    for (const float sign : {-1.0f, 1.0f}) {
      const auto first = static_cast<uint32_t>(input.positions.size());
      const glm::vec3 at = input.positions[i];
      input.positions.push_back(at + sign * size);
      input.positions.push_back(at + sign * glm::vec3(size.x, -size.y, size.z));
      input.indices.insert(input.indices.end(), {i, first, first + 1});
    }
  }
  return input;
}

bool keeps_all(std::span<const uint8_t> locked, const Piece& piece) {
  const auto kept = std::count_if(piece.sources.begin(), piece.sources.end(),
                                  [&](uint32_t source) { return locked[source] != 0; });
  return kept == std::count_if(locked.begin(), locked.end(), [](uint8_t lock) { return lock != 0; });
}

}  // namespace

Piece simplify_with_meshopt(const Surface& surface, std::span<const uint8_t> locked, size_t triangles) {
  const Input input = make_input(surface, locked);
  const size_t flags = input.indices.size() - 3 * surface.triangles.size();
  std::vector<uint32_t> indices(input.indices.size());
  indices.resize(meshopt_simplify(indices.data(), input.indices.data(), input.indices.size(),
                                  &input.positions[0].x, input.positions.size(), sizeof(glm::vec3),
                                  3 * triangles + flags, 1e9f, 0, nullptr));
  std::vector<Triangle> kept;
  for (size_t i = 0; i < indices.size(); i += 3) {
    const uint32_t* corners = &indices[i];
    if (std::any_of(corners, corners + 3, [&](uint32_t c) { return c >= input.vertices.size(); })) continue;
    const Triangle triangle{{input.vertices[corners[0]].point, input.vertices[corners[1]].point,
                             input.vertices[corners[2]].point},
                            input.vertices[corners[0]].material};
    const auto& [a, b, c] = triangle.vertices;
    if (!degenerate(surface.points[a], surface.points[b], surface.points[c])) kept.push_back(triangle);
  }
  Piece piece = extract(surface.points, kept);
  return !kept.empty() && (locked.empty() || keeps_all(locked, piece))
             ? piece
             : extract(surface.points, surface.triangles);
}

}  // namespace triptych
