#include "samples/services/furniture_parts.hpp"

#include "samples/services/part_tools.hpp"

#include <cmath>
#include <fmt/core.h>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

const glm::dvec3 steel(0.42, 0.44, 0.46), white(0.80, 0.80, 0.78), dark(0.10, 0.10, 0.11);

glm::dvec3 wood(int variant) {
  constexpr double tints[4][3] = {
      {0.42, 0.27, 0.13}, {0.55, 0.42, 0.26}, {0.62, 0.60, 0.55}, {0.30, 0.17, 0.08}};
  const auto& tint = tints[variant % 4];
  return {tint[0], tint[1], tint[2]};
}

glm::dvec3 cloth(int variant) {
  constexpr double tints[4][3] = {
      {0.10, 0.22, 0.42}, {0.12, 0.36, 0.30}, {0.45, 0.14, 0.10}, {0.30, 0.31, 0.33}};
  const auto& tint = tints[variant % 4];
  return {tint[0], tint[1], tint[2]};
}

/// Legs at the corners of a footprint.
void add_legs(MeshPart& part, double x, double z, double height, double radius, size_t sides = 8) {
  for (const double sx : {-1.0, 1.0})
    for (const double sz : {-1.0, 1.0})
      add_rod(part, {sx * x, 0, sz * z}, {sx * x, height, sz * z}, radius, sides);
}

void add_castor(MeshPart& part, const glm::dvec3& at) {
  add_rod(part, at + glm::dvec3(-0.012, 0.04, 0), at + glm::dvec3(0.012, 0.04, 0), 0.04, 8);
}

std::string numbered(const char* name, int variant) { return fmt::format("{} {}", name, variant + 1); }

}  // namespace

FurnitureModel bed(int variant) {
  return {numbered("bed", variant), {1.0, 2.15}, [variant] {
            MeshPart frame = part_of(steel), mattress = part_of({0.70, 0.74, 0.78}),
                     ends = part_of(wood(variant));
            add_box(frame, {-0.45, 0.4, -1.0}, {0.45, 0.46, 1.0});
            add_box(frame, {-0.35, 0.12, -0.8}, {0.35, 0.18, 0.8});
            add_legs(frame, 0.3, 0.6, 0.4, 0.025);
            for (const double x : {-0.38, 0.38})
              for (const double z : {-0.85, 0.85}) add_castor(frame, {x, 0, z});
            for (const double x : {-0.49, 0.49}) {
              add_rod(frame, {x, 0.85, -0.7}, {x, 0.85, 0.3}, 0.014, 6);
              for (int i = 0; i < 4; ++i)
                add_rod(frame, {x, 0.42, -0.65 + 0.3 * i}, {x, 0.85, -0.65 + 0.3 * i}, 0.009, 5);
            }
            add_box(mattress, {-0.44, 0.46, -0.98}, {0.44, 0.6, 0.98});
            add_box(mattress, {-0.3, 0.6, -0.95}, {0.3, 0.7, -0.55});
            add_box(ends, {-0.47, 0.3, -1.06}, {0.47, 0.98, -1.02});
            add_box(ends, {-0.47, 0.3, 1.02}, {0.47, 0.8, 1.06});
            return MeshParts{frame, mattress, ends};
          }};
}

FurnitureModel bedside_table(int variant) {
  return {numbered("bedside table", variant), {0.5, 0.5}, [variant] {
            MeshPart body = part_of(wood(variant)), trim = part_of(steel);
            add_box(body, {-0.22, 0.1, -0.22}, {0.22, 0.78, 0.22});
            add_box(body, {-0.24, 0.78, -0.24}, {0.24, 0.81, 0.24});
            for (int i = 0; i < 2 + variant; ++i) {
              const double y = 0.14 + 0.62 * i / (2 + variant);
              add_box(body, {-0.2, y, 0.22}, {0.2, y + 0.56 / (2 + variant), 0.235});
              add_rod(trim, {-0.05, y + 0.1, 0.245}, {0.05, y + 0.1, 0.245}, 0.006, 6);
            }
            for (const double x : {-0.18, 0.18})
              for (const double z : {-0.18, 0.18}) add_castor(trim, {x, 0, z});
            return MeshParts{body, trim};
          }};
}

FurnitureModel chair(int variant) {
  return {numbered("chair", variant), {0.5, 0.52}, [variant] {
            MeshPart frame = part_of(steel), seat = part_of(cloth(variant));
            add_legs(frame, 0.21, 0.2, 0.44, 0.011, variant % 2 ? 6 : 8);
            for (const double x : {-0.21, 0.21}) {
              add_rod(frame, {x, 0.44, -0.2}, {x, 0.86, -0.25}, 0.011);
              if (variant >= 2) {
                add_rod(frame, {x, 0.44, 0.2}, {x, 0.66, 0.2}, 0.011);
                add_box(seat, {x - 0.025, 0.66, -0.22}, {x + 0.025, 0.69, 0.22});
              }
            }
            add_box(seat, {-0.22, 0.43, -0.21}, {0.22, 0.48, 0.24});
            add_box(seat, {-0.2, 0.6, -0.25}, {0.2, 0.88, -0.22});
            return MeshParts{frame, seat};
          }};
}

FurnitureModel armchair(int variant) {
  return {numbered("armchair", variant), {0.72, 0.75}, [variant] {
            MeshPart frame = part_of(wood(variant)), cushion = part_of(cloth(variant + 1));
            add_legs(frame, 0.3, 0.3, 0.2, 0.02, 6);
            add_box(cushion, {-0.27, 0.2, -0.25}, {0.27, 0.44, 0.35});
            add_box(cushion, {-0.27, 0.44, -0.35}, {0.27, 0.95, -0.2});
            for (const double x : {-0.32, 0.32})
              add_box(frame, {x - 0.04, 0.18, -0.33}, {x + 0.04, 0.64, 0.35});
            add_box(cushion, {-0.2, 0.95, -0.34}, {0.2, 1.05, -0.24});
            return MeshParts{frame, cushion};
          }};
}

FurnitureModel office_chair(int variant) {
  return {numbered("office chair", variant), {0.62, 0.62}, [variant] {
            MeshPart frame = part_of(dark), seat = part_of(cloth(variant));
            for (int i = 0; i < 5; ++i) {
              const double turn = glm::two_pi<double>() * i / 5;
              const glm::dvec3 out(0.28 * std::cos(turn), 0.07, 0.28 * std::sin(turn));
              add_rod(frame, {0, 0.09, 0}, out, 0.018, 6);
              add_castor(frame, {out.x, 0, out.z});
            }
            add_turned(frame, {0, 0.07, 0}, 1, {{0, 0.04}, {0.1, 0.03}, {0.34, 0.02}}, 8);
            add_box(seat, {-0.24, 0.42, -0.22}, {0.24, 0.5, 0.25});
            add_box(seat, {-0.21, 0.62, -0.27}, {0.21, 1.0 + 0.08 * variant, -0.21});
            add_rod(frame, {0, 0.44, -0.2}, {0, 0.75, -0.28}, 0.02, 6);
            for (const double x : {-0.27, 0.27}) {
              add_rod(frame, {x, 0.45, 0}, {x, 0.66, 0}, 0.014, 6);
              add_box(frame, {x - 0.03, 0.66, -0.12}, {x + 0.03, 0.69, 0.14});
            }
            return MeshParts{frame, seat};
          }};
}

FurnitureModel stool(int variant) {
  return {numbered("stool", variant), {0.5, 0.5}, [variant] {
            MeshPart frame = part_of(steel), seat = part_of(cloth(variant + 2));
            for (int i = 0; i < 5; ++i) {
              const double turn = glm::two_pi<double>() * i / 5;
              add_rod(frame, {0, 0.1, 0}, {0.23 * std::cos(turn), 0.05, 0.23 * std::sin(turn)}, 0.014, 6);
              add_castor(frame, {0.23 * std::cos(turn), 0, 0.23 * std::sin(turn)});
            }
            add_rod(frame, {0, 0.08, 0}, {0, 0.5, 0}, 0.02, 8);
            add_torus(frame, {0, 0.22, 0}, 1, 0.17, 0.01, 10, 5);
            add_turned(seat, {0, 0.5, 0}, 1, {{0, 0.15}, {0.02, 0.18}, {0.06, 0.18}, {0.08, 0.15}}, 12);
            return MeshParts{frame, seat};
          }};
}

FurnitureModel desk(int variant) {
  const double width = 1.4 + 0.2 * variant;
  return {
      numbered("desk", variant), {width, 0.8}, [=] {
        MeshPart top = part_of(wood(variant)), frame = part_of(steel);
        add_box(top, {-width / 2, 0.71, -0.4}, {width / 2, 0.74, 0.4});
        add_legs(frame, width / 2 - 0.06, 0.34, 0.71, 0.02);
        add_box(top, {-width / 2 + 0.05, 0.3, -0.36}, {width / 2 - 0.05, 0.7, -0.34});
        add_box(top, {width / 2 - 0.5, 0.06, -0.3}, {width / 2 - 0.08, 0.66, 0.32});
        for (int i = 0; i < 3; ++i) {
          add_box(top, {width / 2 - 0.49, 0.08 + 0.2 * i, 0.32}, {width / 2 - 0.09, 0.26 + 0.2 * i, 0.335});
          add_rod(frame, {width / 2 - 0.35, 0.19 + 0.2 * i, 0.345}, {width / 2 - 0.23, 0.19 + 0.2 * i, 0.345},
                  0.006, 6);
        }
        return MeshParts{top, frame};
      }};
}

FurnitureModel table(int variant) {
  const double width = 0.8 + 0.25 * variant;
  return {numbered("table", variant), {width, 0.8}, [=] {
            MeshPart top = part_of(wood(variant + 1)), frame = part_of(steel);
            add_box(top, {-width / 2, 0.71, -0.4}, {width / 2, 0.74, 0.4});
            add_box(frame, {-width / 2 + 0.06, 0.66, -0.34}, {width / 2 - 0.06, 0.71, 0.34});
            add_legs(frame, width / 2 - 0.06, 0.34, 0.66, 0.02, 12);
            return MeshParts{top, frame};
          }};
}

FurnitureModel cabinet(int variant) {
  const double width = 0.8 + 0.2 * variant, height = variant % 2 ? 1.95 : 1.2;
  return {numbered("cabinet", variant), {width, 0.45}, [=] {
            MeshPart body = part_of(wood(variant + 2)), trim = part_of(steel);
            add_box(body, {-width / 2, 0.06, -0.22}, {width / 2, height, 0.2});
            add_box(trim, {-width / 2 + 0.03, 0, -0.2}, {width / 2 - 0.03, 0.06, 0.17});
            const int doors = 2 + variant / 2;
            for (int i = 0; i < doors; ++i) {
              const double x0 = -width / 2 + width * i / doors + 0.005, x1 = x0 + width / doors - 0.01;
              add_box(body, {x0, 0.07, 0.2}, {x1, height - 0.01, 0.22});
              add_rod(trim, {x1 - 0.05, height / 2, 0.235}, {x1 - 0.05, height / 2 + 0.14, 0.235}, 0.007, 6);
              for (const double y : {0.2, height - 0.2})
                add_rod(trim, {x0, y, 0.222}, {x0, y + 0.06, 0.222}, 0.008, 5);
            }
            return MeshParts{body, trim};
          }};
}

FurnitureModel shelf(int variant) {
  const double width = 1.0 + 0.1 * variant;
  return {numbered("shelf", variant), {width, 0.5}, [=] {
            MeshPart frame = part_of(steel), boards = part_of(wood(variant + 1)),
                     boxes = part_of(cloth(variant)), others = part_of({0.55, 0.46, 0.32});
            for (const double x : {-width / 2 + 0.02, width / 2 - 0.02})
              for (const double z : {-0.22, 0.22})
                add_box(frame, {x - 0.02, 0, z - 0.02}, {x + 0.02, 2.0, z + 0.02});
            for (int level = 0; level < 5; ++level) {
              const double y = 0.1 + 0.45 * level;
              add_box(boards, {-width / 2, y, -0.24}, {width / 2, y + 0.025, 0.24});
              if (level == 4) break;
              for (int i = 0; i < 4; ++i) {
                if ((level * 7 + i * 5 + variant * 3) % 6 == 0) continue;
                const double x = width * ((i + 0.5) / 4 - 0.5), wide = width / 4 * 0.42,
                             tall = 0.16 + 0.05 * ((level + 2 * i + variant) % 4);
                add_box((level + i) % 2 ? boxes : others, {x - wide, y + 0.025, -0.2},
                        {x + wide, y + 0.025 + tall, 0.2});
              }
            }
            return MeshParts{frame, boards, boxes, others};
          }};
}

FurnitureModel bench(int variant) {
  const double width = 1.8 + 0.3 * variant;
  return {numbered("laboratory bench", variant), {width, 0.75}, [=] {
            MeshPart top = part_of({0.16, 0.17, 0.18}), body = part_of(white), trim = part_of(steel);
            add_box(top, {-width / 2, 0.88, -0.37}, {width / 2, 0.92, 0.37});
            add_box(body, {-width / 2 + 0.02, 0.1, -0.35}, {width / 2 - 0.02, 0.88, 0.33});
            const int doors = 4;
            for (int i = 0; i < doors; ++i) {
              const double x0 = -width / 2 + 0.03 + (width - 0.06) * i / doors,
                           x1 = x0 + (width - 0.06) / doors - 0.01;
              add_box(body, {x0, 0.12, 0.33}, {x1, 0.66, 0.348});
              add_box(body, {x0, 0.68, 0.33}, {x1, 0.86, 0.348});
              add_rod(trim, {x0 + 0.1, 0.77, 0.36}, {x1 - 0.1, 0.77, 0.36}, 0.006, 5);
            }
            add_rod(trim, {0.3, 0.92, -0.28}, {0.3, 1.25, -0.28}, 0.012);
            add_rod(trim, {0.3, 1.25, -0.28}, {0.3, 1.2, -0.1}, 0.01);
            for (const double x : {0.22, 0.38})
              add_turned(trim, {x, 0.92, -0.28}, 1, {{0, 0.01}, {0.07, 0.01}, {0.08, 0.03}, {0.1, 0.03}}, 8);
            add_box(body, {-width / 2 + 0.1, 1.3, -0.37}, {width / 2 - 0.1, 1.33, -0.12});
            return MeshParts{top, body, trim};
          }};
}

FurnitureModel couch(int variant) {
  return {numbered("couch", variant), {0.72, 1.95}, [variant] {
            MeshPart frame = part_of(steel), pad = part_of(cloth(variant + 1));
            add_legs(frame, 0.28, 0.8, 0.55, 0.022);
            add_box(frame, {-0.31, 0.5, -0.9}, {0.31, 0.56, 0.9});
            add_box(pad, {-0.34, 0.56, -0.4}, {0.34, 0.66, 0.96});
            add_box(pad, {-0.34, 0.58, -0.95}, {0.34, 0.7, -0.42});
            add_rod(frame, {-0.3, 0.2, -0.8}, {-0.3, 0.2, 0.8}, 0.015);
            add_rod(frame, {0.3, 0.2, -0.8}, {0.3, 0.2, 0.8}, 0.015);
            return MeshParts{frame, pad};
          }};
}

FurnitureModel wash_basin(int variant) {
  return {numbered("wash basin", variant), {0.56, 0.48}, [variant] {
            MeshPart basin = part_of(white), tap = part_of(steel);
            const double y = 0.72, r = 0.2 + 0.01 * variant;
            add_box(basin, {-0.27, y + 0.1, -0.24}, {0.27, y + 0.14, -0.12});
            add_torus(basin, {0, y + 0.12, 0.02}, 1, r, 0.022, 16, 6);
            add_turned(basin, {0, y, 0.02}, 1, {{0, 0.06}, {0.02, 0.12}, {0.06, r - 0.02}, {0.11, r}}, 16);
            add_rod(tap, {0, y + 0.14, -0.17}, {0, y + 0.26, -0.17}, 0.014);
            add_rod(tap, {0, y + 0.25, -0.17}, {0, y + 0.23, -0.03}, 0.011);
            add_rod(tap, {0, y - 0.12, 0.02}, {0, y, 0.02}, 0.02);
            add_rod(tap, {0, y - 0.1, 0.02}, {0, y - 0.1, -0.24}, 0.018);
            for (const double x : {-0.1, 0.1})
              add_turned(tap, {x, y + 0.14, -0.18}, 1, {{0, 0.012}, {0.04, 0.012}, {0.045, 0.02}}, 6);
            return MeshParts{basin, tap};
          }};
}

FurnitureModel toilet(int variant) {
  return {numbered("toilet", variant), {0.4, 0.68}, [] {
            MeshPart bowl = part_of(white), trim = part_of(steel);
            add_turned(bowl, {0, 0.02, 0.1}, 1, {{0, 0.12}, {0.12, 0.1}, {0.25, 0.16}, {0.36, 0.19}}, 16);
            add_torus(bowl, {0, 0.4, 0.1}, 1, 0.17, 0.02, 16, 6);
            add_box(bowl, {-0.19, 0.38, -0.34}, {0.19, 0.78, -0.16});
            add_box(bowl, {-0.08, 0.1, -0.34}, {0.08, 0.36, 0});
            add_rod(trim, {0, 0.78, -0.25}, {0, 0.8, -0.25}, 0.03, 10);
            return MeshParts{bowl, trim};
          }};
}

FurnitureModel drip_stand(int variant) {
  return {numbered("drip stand", variant), {0.5, 0.5}, [] {
            MeshPart frame = part_of(steel), bag = part_of({0.72, 0.76, 0.80});
            for (int i = 0; i < 5; ++i) {
              const double turn = glm::two_pi<double>() * i / 5;
              add_rod(frame, {0, 0.1, 0}, {0.22 * std::cos(turn), 0.07, 0.22 * std::sin(turn)}, 0.012, 6);
              add_castor(frame, {0.22 * std::cos(turn), 0, 0.22 * std::sin(turn)});
            }
            add_rod(frame, {0, 0.08, 0}, {0, 1.9, 0}, 0.013, 8);
            add_rod(frame, {-0.12, 1.88, 0}, {0.12, 1.88, 0}, 0.007, 6);
            add_box(bag, {-0.16, 1.55, -0.02}, {-0.06, 1.82, 0.02});
            add_box(frame, {-0.07, 1.1, 0.01}, {0.07, 1.35, 0.12});
            return MeshParts{frame, bag};
          }};
}

FurnitureModel waste_bin(int variant) {
  return {numbered("waste bin", variant), {0.34, 0.34}, [variant] {
            MeshPart body = part_of(cloth(variant + 3)), lid = part_of(steel);
            add_turned(body, {0, 0, 0}, 1, {{0, 0.13}, {0.5 + 0.05 * variant, 0.16}}, 12);
            add_turned(lid, {0, 0.5 + 0.05 * variant, 0}, 1, {{0, 0.165}, {0.03, 0.16}, {0.05, 0.05}}, 12);
            return MeshParts{body, lid};
          }};
}

}  // namespace triptych
