#include "samples/effects/effects.hpp"

#include "samples/effects/moving.hpp"
#include "samples/effects/textured.hpp"
#include "samples/gltf_writer.hpp"
#include "samples/orbits.hpp"
#include "samples/shape.hpp"
#include "samples/smooth.hpp"
#include "samples/solids.hpp"

#include <cmath>
#include <fmt/core.h>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace triptych {

namespace {

/// Which effects a file calls for.
struct Called {
  bool transparency = false, vertex_colours = false, smooth_normals = false, textures = false,
       emission = false, motion = false;
  bool lights = false;  ///< that a build may bake
};

constexpr int cases = 4, screens = 5, lamps = 3;
/// Metres, from the middle: half of the floor's sides, and how high things are.
constexpr double half_width = 5, half_depth = 3.5, height = 2.6;

MeshPart pane(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& colour, double alpha,
              const Called& called) {
  MeshPart part = box(low, high, colour);
  if (called.transparency) part.alpha = alpha;
  return part;
}

MeshPart shaded(const MeshPart& part, const Called& called) {
  return called.smooth_normals ? with_smooth_normals(part) : part;
}

/// A stand, a figure on it, and a case of five panes of glass around it.
std::vector<MeshPart> show_case(int number, const Called& called) {
  const glm::dvec3 stand(0.25, 0.22, 0.2), glass(0.75, 0.9, 0.85);
  constexpr double half = 0.4, stand_height = 0.9, top = 1.7, thick = 0.02;
  std::vector<MeshPart> parts = {box({-half, 0, -half}, {half, stand_height, half}, stand)};
  Shape figure(glm::dvec3(0.8, 0.25 + 0.15 * number, 0.15));
  std::vector<glm::dvec2> profile;
  for (int i = 0; i <= 24; ++i) {
    const double along = i / 24.0;
    profile.push_back({along * 0.6, 0.06 + 0.12 * std::abs(std::sin((2 + number) * along * 2.2))});
  }
  figure.turned({0, stand_height, 0}, 1, profile);
  parts.push_back(shaded(figure.mesh(1500), called));
  const auto add = [&](const glm::dvec3& low, const glm::dvec3& high) {
    parts.push_back(pane(low, high, glass, 0.25, called));
  };
  add({-half, stand_height, -half}, {-half + thick, top, half});
  add({half - thick, stand_height, -half}, {half, top, half});
  add({-half + thick, stand_height, -half}, {half - thick, top, -half + thick});
  add({-half + thick, stand_height, half - thick}, {half - thick, top, half});
  add({-half, top, -half}, {half, top + thick, half});
  return parts;
}

/// A screen of three panes of coloured glass in a frame.
std::vector<MeshPart> screen(int number, const Called& called) {
  const glm::dvec3 frame(0.6, 0.6, 0.62);
  const glm::dvec3 colours[] = {{0.8, 0.1, 0.1}, {0.1, 0.5, 0.8}, {0.9, 0.7, 0.1}};
  constexpr double width = 0.9, top = 2, bar = 0.05, thick = 0.015;
  std::vector<MeshPart> parts;
  for (int i = 0; i <= 3; ++i)
    parts.push_back(box({i * width - bar / 2, 0, -bar / 2}, {i * width + bar / 2, top, bar / 2}, frame));
  for (int i = 0; i < 3; ++i) {
    parts.push_back(pane({i * width + bar / 2, 0.1, -thick / 2}, {(i + 1) * width - bar / 2, top, thick / 2},
                         colours[(i + number) % 3], 0.35 + 0.1 * i, called));
  }
  return parts;
}

/// A relief before the back wall, which changes its colour with its height.
MeshPart relief(const Called& called) {
  constexpr int columns = 60, rows = 30;
  constexpr double width = 6, tall = 1.8, deep = 0.25;
  MeshPart part;
  part.colour = called.vertex_colours ? glm::dvec3(1) : glm::dvec3(0.5, 0.45, 0.4);
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const double u = column / double{columns}, v = row / double{rows};
      const double wave = 0.5 + 0.25 * (std::sin(9 * u) * std::cos(7 * v) + std::sin(17 * u + 5 * v));
      const bool rim = row == 0 || column == 0 || row == rows || column == columns;
      part.positions.emplace_back((u - 0.5) * width, 0.4 + v * tall, rim ? 0.0 : deep * wave);
      const auto channel = [&](double value) { return static_cast<uint8_t>(std::lround(255 * value)); };
      part.vertex_colours.push_back({channel(wave), channel(0.25 + 0.5 * u), channel(1 - wave), 255});
    }
  }
  if (!called.vertex_colours) part.vertex_colours.clear();
  constexpr uint32_t stride = columns + 1;
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t column = 0; column < columns; ++column) {
      const uint32_t first = row * stride + column;
      for (const uint32_t corner :
           {first, first + 1, first + stride + 1, first, first + stride + 1, first + stride})
        part.indices.push_back(corner);
    }
  }
  return shaded(part, called);
}

std::vector<MeshPart> hall() {
  const glm::dvec3 floor(0.55, 0.5, 0.45), wall(0.75, 0.75, 0.72);
  constexpr double thick = 0.2;
  return {box({-half_width, -thick, -half_depth}, {half_width, 0, half_depth}, floor),
          box({-half_width, 0, -half_depth - thick}, {half_width, height, -half_depth}, wall),
          box({-half_width - thick, 0, -half_depth - thick}, {-half_width, height, half_depth}, wall)};
}

class Exhibition {
 public:
  Exhibition(const std::filesystem::path& folder, const std::string& name, const Called& called)
      : writer_(folder, "triptych sample effects", name), called_(called) {
    add("hall", hall(), glm::dmat4(1));
    add("relief", {relief(called_)}, at(0, -half_depth, 0));
    for (int i = 0; i < cases; ++i)
      add(fmt::format("case {}", i + 1), show_case(i, called_), at(-3.2 + 2.1 * i, -1.2, 0));
    for (int i = 0; i < screens; ++i)
      add(fmt::format("screen {}", i + 1), screen(i, called_),
          at(-4 + 1.3 * i, 1 + 0.35 * i, std::numbers::pi / 12 * i));
    add("carpet", {carpet(called_.textures)}, at(0, 0.4, 0));
    add("fence", {fence(called_.textures)}, at(-2, 2.6, 0));
    for (int i = 0; i < lamps; ++i)
      add(fmt::format("lamp {}", i + 1), lamp(called_.textures, called_.emission),
          at(-3 + 3.0 * i, -half_depth + 0.6, 0));
    for (int i = 0; called_.lights && i < lamps; ++i)
      writer_.add_light_node(writer_.add_point_light(fmt::format("light {}", i + 1), {1, 0.85, 0.65}, 60),
                             {-3 + 3.0 * i, 2.5, 0.2});
    const MovingThings moving = add_moving_things(writer_, called_.motion);
    objects += moving.objects;
    triangles += moving.triangles;
    writer_.finish();
  }

  size_t objects = 0;
  uint64_t triangles = 0;

 private:
  static glm::dmat4 at(double x, double z, double turn) {
    return glm::rotate(glm::translate(glm::dmat4(1), {x, 0.0, z}), turn, {0.0, 1.0, 0.0});
  }
  void add(const std::string& name, const std::vector<MeshPart>& parts, const glm::dmat4& transform) {
    writer_.add_node(name, writer_.add_mesh(name, parts), transform);
    ++objects;
    for (const MeshPart& part : parts) triangles += part.indices.size() / 3;
  }

  GltfWriter writer_;
  Called called_;
};

}  // namespace

EffectsReport make_effects(const std::filesystem::path& folder) {
  EffectsReport report;
  make_folder(folder);
  write_effect_images(folder);
  for (const auto& [name, effects, called, build] :
       {std::tuple{"scene", "all", Called{true, true, true, true, true, true, true}, "--bake-light"},
        {"plain", "none", Called{}, ""},
        {"transparency", "transparency", Called{.transparency = true}, ""},
        {"vertex-colours", "vertex-colours", Called{.vertex_colours = true}, ""},
        {"smooth-normals", "smooth-normals", Called{.smooth_normals = true}, ""},
        {"textures", "textures", Called{.textures = true}, ""},
        {"emission", "emission", Called{.emission = true}, ""},
        {"moving-instances", "moving-instances", Called{.motion = true}, ""},
        {"baked-light", "baked-light", Called{.lights = true}, "--bake-light"},
        {"ambient-occlusion", "ambient-occlusion", Called{}, "--ambient"}}) {
    const Exhibition exhibition(folder, name, called);
    report.files.push_back({std::string(name) + ".gltf", effects, build});
    report.objects = exhibition.objects;
    report.triangles = exhibition.triangles;
  }
  write_orbits({.centre = {0, 1, 0},
                .radius = 9,
                .closest = 2.5,
                .low = 0.8,
                .high = 3,
                .spin = {0.3, 1.6, 2.9},
                .frames_a_second = 30},
               Random(1), folder);
  return report;
}

}  // namespace triptych
