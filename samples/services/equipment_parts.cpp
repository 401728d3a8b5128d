// The larger and smaller things of furniture_parts.hpp that carry switches.
#include "samples/services/furniture_parts.hpp"
#include "samples/services/part_tools.hpp"

#include <fmt/core.h>

namespace triptych {
namespace {

const glm::dvec3 steel(0.42, 0.44, 0.46), white(0.80, 0.80, 0.78), dark(0.10, 0.10, 0.11);

std::string numbered(const char* name, int variant) { return fmt::format("{} {}", name, variant + 1); }

}  // namespace

FurnitureModel trolley(int variant) {
  return {numbered("monitor trolley", variant), {0.6, 0.55}, [variant] {
            MeshPart frame = part_of(steel), body = part_of(white), screen = part_of(dark);
            for (const double x : {-0.25, 0.25})
              for (const double z : {-0.22, 0.22}) {
                add_rod(frame, {x, 0.08, z}, {x, 1.0, z}, 0.014);
                add_rod(frame, {x - 0.012, 0.04, z}, {x + 0.012, 0.04, z}, 0.04, 8);
              }
            for (int i = 0; i < 3; ++i)
              add_box(body, {-0.27, 0.2 + 0.38 * i, -0.24}, {0.27, 0.22 + 0.38 * i, 0.24});
            add_box(body, {-0.2, 0.6, -0.2}, {0.2, 0.78 + 0.03 * variant, 0.2});
            add_box(screen, {-0.22, 1.1, -0.05}, {0.22, 1.42, -0.01});
            add_rod(frame, {0, 0.98, -0.05}, {0, 1.12, -0.05}, 0.02);
            for (int i = 0; i < 4; ++i)
              add_turned(frame, {-0.15 + 0.1 * i, 0.68, 0.2}, 2, {{0, 0.018}, {0.015, 0.014}}, 8);
            return MeshParts{frame, body, screen};
          }};
}

FurnitureModel air_handler(int variant) {
  const double length = 3.2 + 0.4 * variant;
  return {numbered("air handling unit", variant), {length, 1.5}, [=] {
            MeshPart body = part_of({0.58, 0.60, 0.62}), trim = part_of(dark), frame = part_of(steel);
            add_box(frame, {-length / 2, 0, -0.7}, {length / 2, 0.12, 0.7});
            const int sections = 4 + variant % 2;
            for (int i = 0; i < sections; ++i) {
              const double x0 = -length / 2 + length * i / sections + 0.01,
                           x1 = x0 + length / sections - 0.02;
              add_box(body, {x0, 0.12, -0.7}, {x1, 2.0, 0.68});
              add_box(body, {x0 + 0.06, 0.2, 0.68}, {x1 - 0.06, 1.9, 0.7});
              add_rod(trim, {x1 - 0.12, 0.9, 0.72}, {x1 - 0.12, 1.1, 0.72}, 0.012, 6);
              for (const double y : {0.35, 1.75})
                add_rod(trim, {x0 + 0.08, y, 0.705}, {x0 + 0.08, y + 0.1, 0.705}, 0.012, 6);
            }
            for (const double y : {0.6, 1.0, 1.4})
              for (const double side : {-1.0, 1.0})
                add_box(trim, {side * length / 2 - 0.02, y, -0.5}, {side * length / 2 + 0.02, y + 0.05, 0.5});
            add_turned(frame, {0, 2.0, 0}, 1, {{0, 0.3}, {0.1, 0.3}}, 16);
            return MeshParts{body, trim, frame};
          }};
}

FurnitureModel monitor(int variant) {
  return {numbered("monitor", variant), {0.55, 0.22}, [variant] {
            MeshPart body = part_of(dark), foot = part_of(steel);
            const double half = 0.24 + 0.02 * variant;
            add_box(body, {-half, 0.12, -0.02}, {half, 0.46, 0.02});
            add_box(foot, {-half + 0.01, 0.13, 0.02}, {half - 0.01, 0.45, 0.022});
            add_rod(foot, {0, 0.01, -0.03}, {0, 0.25, -0.03}, 0.018, 8);
            add_turned(foot, {0, 0, 0}, 1, {{0, 0.11}, {0.012, 0.1}}, 12);
            return MeshParts{body, foot};
          }};
}

FurnitureModel keyboard(int variant) {
  return {numbered("keyboard", variant), {0.45, 0.16}, [] {
            MeshPart body = part_of(dark), keys = part_of({0.2, 0.2, 0.21});
            add_box(body, {-0.22, 0, -0.07}, {0.22, 0.018, 0.07});
            for (int row = 0; row < 4; ++row)
              for (int i = 0; i < 7; ++i)
                add_box(keys, {-0.21 + 0.06 * i, 0.018, -0.06 + 0.03 * row},
                        {-0.155 + 0.06 * i, 0.024, -0.035 + 0.03 * row});
            return MeshParts{body, keys};
          }};
}

}  // namespace triptych
