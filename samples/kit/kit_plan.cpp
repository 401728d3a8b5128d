#include "samples/kit/kit_plan.hpp"

#include <algorithm>
#include <numbers>

namespace triptych {

namespace {

using Colour = std::array<uint8_t, 3>;
using Outline = std::vector<glm::dvec2>;

constexpr Colour concrete{150, 152, 148}, brick{178, 84, 60}, plaster{230, 220, 196}, wood{139, 94, 52},
    steel{70, 110, 160}, tile{150, 36, 44}, green{64, 140, 72};
constexpr double ceiling = 2.7;

Outline rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Outline hexagon(const glm::dvec2& centre, double radius) {
  Outline outline;
  for (int i = 0; i < 6; ++i) {
    const double turn = i * std::numbers::pi / 3;
    outline.push_back(centre + radius * glm::dvec2(std::cos(turn), std::sin(turn)));
  }
  return outline;
}

std::vector<KitSolid> ground_floor() {
  return {
      {"Slab", 0, concrete, true, rectangle(-1.5, -2.1, 8.2, 5.4), -0.3, 0},
      {"Wall south", 0, brick, true, rectangle(-1, -1.6, 7.5, -1.35), 0, ceiling},
      {"Wall west",
       0,
       brick,
       true,
       {{-0.75, 4.65}, {2, 4.65}, {2, 4.9}, {-1, 4.9}, {-1, -1.35}, {-0.75, -1.35}},
       0,
       ceiling},
      {"Wall north", 0, brick, true, rectangle(3, 4.65, 7.5, 4.9), 0, ceiling},
      {"Wall east", 0, brick, true, rectangle(7.25, -1.35, 7.5, 4.65), 0, ceiling},
      {"Wall inside", 0, plaster, false, {{2.5, 0}, {6, 0}, {6, 2}, {4, ceiling}, {2.5, ceiling}}, 1.5, 1.65},
      {"Door", 0, wood, true, rectangle(2, 4.72, 3, 4.78), 0, 2.1},
      {"Column", 0, steel, true, hexagon({5, -0.3}, 0.2), 0, ceiling},
      {"Table top", 0, wood, true, rectangle(0.5, 0.2, 2.1, 1), 0.7, 0.74},
      {"Table leg west", 0, steel, true, rectangle(0.6, 0.56, 0.68, 0.64), 0, 0.7},
      {"Table leg east", 0, steel, true, rectangle(1.92, 0.56, 2, 0.64), 0, 0.7},
      {"Bench", 0, green, true, {{7.6, -2}, {8.1, -1.9}, {8, -0.5}, {7.6, -0.7}}, 0, 0.45},
  };
}

std::vector<KitSolid> roof() {
  return {
      {"Slab above", 1, concrete, true, rectangle(-1.2, -1.8, 7.7, 5.1), ceiling, 2.9},
      {"Roof", 1, tile, false, {{-1.4, 2.9}, {7.9, 2.9}, {2.6, 4.75}}, -2, 5.3},
  };
}

}  // namespace

const std::vector<KitStorey>& kit_storeys() {
  static const std::vector<KitStorey> storeys = {{"Ground floor", 0}, {"Upper floor", ceiling}};
  return storeys;
}

const std::vector<KitSolid>& kit_solids() {
  static const std::vector<KitSolid> solids = [] {
    std::vector<KitSolid> all = ground_floor();
    for (KitSolid& solid : roof()) all.push_back(std::move(solid));
    return all;
  }();
  return solids;
}

glm::dvec3 kit_point(const KitSolid& solid, const glm::dvec2& point, double along) {
  return solid.upright ? glm::dvec3(point, along) : glm::dvec3(point.x, along, point.y);
}

KitMesh mesh_of(const KitSolid& solid) {
  KitMesh mesh;
  const auto count = static_cast<uint32_t>(solid.outline.size());
  for (const double along : {solid.from, solid.to})
    for (const glm::dvec2& point : solid.outline) mesh.positions.push_back(kit_point(solid, point, along));
  for (uint32_t i = 1; i + 1 < count; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({count, count + i, count + i + 1});
  }
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({i, next, count + next});
    mesh.triangles.push_back({i, count + next, count + i});
  }
  if (!solid.upright)  // x, z and y are left-handed
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

glm::dvec3 turned_y_up(const glm::dvec3& point) { return {point.x, point.z, -point.y}; }

}  // namespace triptych
