#include "light/split_edges.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

LitCorner halfway(const LitCorner& a, const LitCorner& b, uint32_t place) {
  LitCorner corner;
  corner.place = place;
  if (is_colored(a.color) && is_colored(b.color)) {
    for (size_t k = 0; k < 4; ++k) corner.color[k] = static_cast<uint8_t>((a.color[k] + b.color[k] + 1) / 2);
  }
  if (has_normal(a.normal) && has_normal(b.normal))
    corner.normal =
        to_vertex_normal(glm::normalize(direction_of(a.normal)) + glm::normalize(direction_of(b.normal)));
  if (is_on_texture(a.coordinates) && is_on_texture(b.coordinates)) {
    const auto middle = [](int32_t u, int32_t v) { return static_cast<int32_t>((int64_t{u} + v) >> 1); };
    corner.coordinates = {middle(a.coordinates.u, b.coordinates.u), middle(a.coordinates.v, b.coordinates.v)};
  }
  return corner;
}

}  // namespace

void split_edges(LitModel& model, std::span<const uint64_t> edges) {
  const auto first_middle = static_cast<uint32_t>(model.places.size());
  for (const uint64_t edge : edges)
    model.places.push_back((model.places[edge >> 32] + model.places[edge & 0xffffffffu]) * 0.5);
  std::vector<LitTriangle> divided;
  divided.reserve(model.triangles.size() + 2 * edges.size());
  const auto squared = [&](const LitCorner& a, const LitCorner& b) {
    const glm::dvec3 way = model.at(a) - model.at(b);
    return glm::dot(way, way);
  };
  for (const LitTriangle& triangle : model.triangles) {
    const auto& corners = triangle.corners;
    std::array<bool, 3> cut = {};
    std::array<LitCorner, 3> middles;  // of the edge from corner k on
    int cuts = 0;
    for (size_t k = 0; k < 3; ++k) {
      const LitCorner &a = corners[k], &b = corners[(k + 1) % 3];
      const auto found = std::ranges::lower_bound(edges, edge_key(a.place, b.place));
      cut[k] = found != edges.end() && *found == edge_key(a.place, b.place);
      if (!cut[k]) continue;
      middles[k] = halfway(a, b, first_middle + static_cast<uint32_t>(found - edges.begin()));
      ++cuts;
    }
    const auto add = [&](const LitCorner& a, const LitCorner& b, const LitCorner& c) {
      divided.push_back({{a, b, c}, triangle.material, triangle.instance});
    };
    if (cuts == 0) {
      divided.push_back(triangle);
    } else if (cuts == 3) {
      for (size_t k = 0; k < 3; ++k) add(corners[k], middles[k], middles[(k + 2) % 3]);
      add(middles[0], middles[1], middles[2]);
    } else {
      // Turned so that the first edge is cut, or that the last one is not.
      size_t k = 0;
      while (cuts == 1 ? !cut[k] : cut[(k + 2) % 3]) ++k;
      const LitCorner &a = corners[k], &b = corners[(k + 1) % 3], &c = corners[(k + 2) % 3];
      if (cuts == 1) {
        add(a, middles[k], c);
        add(middles[k], b, c);
      } else {
        const LitCorner &ab = middles[k], &bc = middles[(k + 1) % 3];
        add(ab, b, bc);
        if (squared(ab, c) < squared(a, bc)) {  // the shorter diagonal
          add(a, ab, c);
          add(ab, bc, c);
        } else {
          add(a, ab, bc);
          add(a, bc, c);
        }
      }
    }
  }
  model.triangles = std::move(divided);
}

}  // namespace triptych
