#include "preprocess/layers/part_facets.hpp"

#include "preprocess/outward.hpp"
#include "preprocess/triangle_neighbors.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace triptych {

namespace {

class FacetMaker {
 public:
  FacetMaker(const Part& part, const Lattice& lattice, PartFacets& result)
      : surface_(part.surface),
        result_(result),
        neighbors_(surface_.triangles),
        facet_of_(surface_.triangles.size(), no_id),
        tolerance_(PartFacets::flat_steps * lattice.step) {
    for (const glm::ivec3& point : surface_.points) result_.points.push_back(lattice.position(point));
    for (const Triangle& triangle : surface_.triangles) {
      const auto& [a, b, c] = triangle.vertices;
      crosses_.push_back(
          glm::cross(result_.points[b] - result_.points[a], result_.points[c] - result_.points[a]));
    }
  }

  void run() {
    std::vector<uint32_t> by_area(crosses_.size());
    std::iota(by_area.begin(), by_area.end(), 0u);
    std::stable_sort(by_area.begin(), by_area.end(), [&](uint32_t a, uint32_t b) {
      return glm::dot(crosses_[a], crosses_[a]) > glm::dot(crosses_[b], crosses_[b]);
    });
    const std::vector<bool> outward = outward_of_surface();
    for (const uint32_t seed : by_area) {
      if (facet_of_[seed] == no_id && glm::dot(crosses_[seed], crosses_[seed]) > 0) grow(seed, outward);
    }
  }

 private:
  std::vector<bool> outward_of_surface() const {
    std::vector<uint32_t> indices;
    for (const Triangle& triangle : surface_.triangles)
      indices.insert(indices.end(), triangle.vertices.begin(), triangle.vertices.end());
    return outward_triangles(surface_.points, indices);
  }

  void grow(uint32_t seed, const std::vector<bool>& outward) {
    const auto number = static_cast<uint32_t>(result_.facets.size());
    Facet facet;
    facet.point = result_.points[surface_.triangles[seed].vertices[0]];
    facet.normal = glm::normalize(crosses_[seed]);
    facet.color = surface_.colors.empty() ? surface_.triangles[seed].material : no_id;
    facet.first = static_cast<uint32_t>(result_.triangles.size());
    facet.is_outward = true;
    std::vector<uint32_t> front = {seed};
    facet_of_[seed] = number;
    while (!front.empty()) {
      const uint32_t triangle = front.back();
      front.pop_back();
      add(triangle, facet);
      facet.is_outward = facet.is_outward && outward[triangle];
      for (const uint32_t next : neighbors_.of(triangle)) {
        if (next == no_id || facet_of_[next] != no_id || !belongs(next, seed, facet)) continue;
        facet_of_[next] = number;
        front.push_back(next);
      }
    }
    facet.count = static_cast<uint32_t>(result_.triangles.size()) - facet.first;
    result_.facets.push_back(facet);
  }

  void add(uint32_t triangle, Facet& facet) {
    result_.triangles.push_back(surface_.triangles[triangle].vertices);
    result_.numbers.push_back(triangle);
    facet.area += glm::length(crosses_[triangle]) / 2;
    for (const uint32_t corner : surface_.triangles[triangle].vertices)
      facet.box.extend(result_.points[corner]);
  }

  bool belongs(uint32_t triangle, uint32_t seed, const Facet& facet) const {
    const Triangle& candidate = surface_.triangles[triangle];
    return candidate.material == surface_.triangles[seed].material &&
           glm::dot(crosses_[triangle], facet.normal) >= 0 &&
           std::all_of(candidate.vertices.begin(), candidate.vertices.end(), [&](uint32_t corner) {
             return std::abs(glm::dot(result_.points[corner] - facet.point, facet.normal)) <= tolerance_;
           });
  }

  const Surface& surface_;
  PartFacets& result_;
  TriangleNeighbors neighbors_;
  std::vector<uint32_t> facet_of_;
  std::vector<glm::dvec3> crosses_;  ///< normals of triangles, twice as long as their areas
  double tolerance_;
};

BoxTree tree_of(const std::vector<Facet>& facets) {
  std::vector<Box> boxes;
  for (const Facet& facet : facets) boxes.push_back(facet.box);
  return BoxTree(std::move(boxes));
}

}  // namespace

PartFacets::PartFacets(const Part& part, const Lattice& lattice) : tree({}) {
  FacetMaker(part, lattice, *this).run();
  tree = tree_of(facets);
}

}  // namespace triptych
