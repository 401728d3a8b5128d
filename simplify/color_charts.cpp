#include "simplify/color_charts.hpp"

#include "base/disjoint_sets.hpp"

#include <algorithm>
#include <cstdlib>

namespace triptych {

namespace {

/// Of an edge, seen from one of its triangles.
struct Side {
  uint64_t key;  ///< its points, the lower one first
  uint32_t triangle;
  SurfaceCorner low, high;  ///< of its ends
};

bool continues(const Side& a, const Side& b) {
  return color_difference(a.low, b.low) < distinct_colors &&
         color_difference(a.high, b.high) < distinct_colors;
}

std::vector<Side> sides_of(const Surface& surface) {
  std::vector<Side> sides;
  sides.reserve(3 * surface.triangles.size());
  for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& vertices = surface.triangles[t].vertices;
    const SurfaceCorners& colors = surface.colors[t];
    for (size_t k = 0; k < 3; ++k) {
      size_t low = k, high = (k + 1) % 3;
      if (vertices[low] > vertices[high]) std::swap(low, high);
      sides.push_back({uint64_t{vertices[low]} << 32 | vertices[high], t, colors[low], colors[high]});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.key != b.key ? a.key < b.key : a.triangle < b.triangle;
  });
  return sides;
}

}  // namespace

int color_difference(const VertexColor& a, const VertexColor& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

int light_difference(const VertexLight& a, const VertexLight& b) {
  return std::max({2 * std::abs(a[0] - b[0]), 2 * std::abs(a[1] - b[1]), 2 * std::abs(a[2] - b[2]),
                   std::abs(a[3] - b[3])});
}

int color_difference(const SurfaceCorner& a, const SurfaceCorner& b) {
  return std::max(color_difference(a.color, b.color), light_difference(a.light, b.light));
}

ColorCharts color_charts(const Surface& surface) {
  constexpr size_t most = 8;  // triangles at one edge that are compared with each other
  DisjointSets sets(surface.triangles.size());
  const std::vector<Side> sides = sides_of(surface);
  for (size_t first = 0, end = 0; first < sides.size(); first = end) {
    while (end < sides.size() && sides[end].key == sides[first].key) ++end;
    for (size_t a = first; a < std::min(end, first + most); ++a) {
      for (size_t b = a + 1; b < std::min(end, first + most); ++b) {
        const uint32_t t = sides[a].triangle, u = sides[b].triangle;
        if (surface.triangles[t].material == surface.triangles[u].material && continues(sides[a], sides[b]))
          sets.join(t, u);
      }
    }
  }
  constexpr uint32_t none = 0xffffffffu;
  ColorCharts charts;
  std::vector<uint32_t> numbers(surface.triangles.size(), none);
  for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
    uint32_t& number = numbers[sets.root(t)];
    if (number == none) {
      number = static_cast<uint32_t>(charts.materials.size());
      charts.materials.push_back(surface.triangles[t].material);
    }
    charts.of_triangles.push_back(number);
  }
  return charts;
}

}  // namespace triptych
