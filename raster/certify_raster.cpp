#include "raster/certify_raster.hpp"

#include "raster/box_test.hpp"
#include "raster/fill.hpp"
#include "raster/float_state.hpp"
#include "raster/instruction_set.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <random>

namespace triptych {

namespace {

constexpr int side = 256;
constexpr PictureLimits limits{side, side};

/// The same numbers on every machine.
class Numbers {
 public:
  double number(double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(generator_()) * 0x1p-32);
  }

 private:
  std::mt19937 generator_{1};
};

/// In pixels, over the largest picture.
double snapping() {
  Numbers numbers;
  const WindowTransform window(max_picture_side, max_picture_side);
  double furthest = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto w = static_cast<float>(numbers.number(0.1, 1000));
    const auto x = static_cast<float>(numbers.number(-w, w));
    const double exact = (double{x} / double{w} + 1) * (max_picture_side / 2);
    const WindowVertex vertex = window.apply({x, 0, 0.05f, w});
    furthest = std::max(furthest, std::abs(static_cast<double>(vertex.x) / subpixels - exact));
  }
  return furthest;
}

/// A grid of triangles whose inner corners lie anywhere: pixels that are not drawn exactly once.
double fill_rule() {
  constexpr size_t cells = 24;
  Numbers numbers;
  std::vector<WindowVertex> corners;
  for (size_t y = 0; y <= cells; ++y) {
    for (size_t x = 0; x <= cells; ++x) {
      const bool inner = x > 0 && y > 0 && x < cells && y < cells;
      const auto at = [&](size_t cell) {
        const double shake = inner ? numbers.number(-0.24, 0.24) : 0;
        return static_cast<int32_t>((static_cast<double>(cell) + shake) * side * subpixels / cells);
      };
      const int32_t column = at(x), row = at(y);
      corners.push_back({column, row, 0.5f});
    }
  }
  std::vector<int> counts(side * side);
  const auto draw = [&](size_t a, size_t b, size_t c) {
    WindowTriangle triangle;
    if (set_up({corners[a], corners[b], corners[c]}, limits, triangle))
      for_each_pixel(triangle, 0, side - 1,
                     [&](int32_t x, int32_t y, float) { ++counts[static_cast<size_t>(y * side + x)]; });
  };
  for (size_t y = 0; y < cells; ++y) {
    for (size_t x = 0; x < cells; ++x) {
      const size_t a = y * (cells + 1) + x, b = a + 1, c = a + cells + 1, d = c + 1;
      draw(a, b, d);
      draw(c, d, a);
    }
  }
  return static_cast<double>(
      std::count_if(counts.begin(), counts.end(), [](int count) { return count != 1; }));
}

/// Planes at all slants, seen in perspective: the relative error of the depth at pixel centres.
double depth_rounding() {
  Numbers numbers;
  double worst = 0;
  for (int round = 0; round < 200; ++round) {
    const double middle = std::ldexp(numbers.number(0.5, 1), -static_cast<int>(numbers.number(1, 14)));
    const double a = middle * numbers.number(-0.12, 0.12) / side,
                 b = middle * numbers.number(-0.12, 0.12) / side;
    const auto exact = [&](double x, double y) { return middle + a * (x - side / 2) + b * (y - side / 2); };
    const auto corner = [&](int32_t x, int32_t y) {
      return WindowVertex{x * subpixels, y * subpixels, static_cast<float>(exact(x, y))};
    };
    WindowTriangle triangle;
    if (!set_up({corner(-2 * side, -side), corner(3 * side, -side), corner(side / 2, 4 * side)}, limits,
                triangle))
      continue;
    for (int32_t y = 0; y < side; y += 5) {
      for (int32_t x = 0; x < side; x += 3) {
        const double truth = exact(x + 0.5, y + 0.5);
        worst = std::max(worst, std::abs(double{depth_at(triangle, x, y)} - truth) / truth);
      }
    }
  }
  return worst;
}

/// Triangles on one lattice, some of them in one plane, drawn in some order.
class Scene {
 public:
  explicit Scene(bool backwards) : buffer(side, side, false, 1) {
    Numbers numbers;
    skeleton_.lattices.push_back({glm::dvec3(0), 1.0 / 1024});
    skeleton_.transforms.push_back(Affine(1.0));
    skeleton_.scene_nodes.push_back({.box = {glm::ivec3(-100000), glm::ivec3(100000)}});
    View view{.camera = {}, .width = side, .height = side};
    const FrameView frame(skeleton_, {view});
    Chunk chunk;
    for (uint32_t i = 0; i < 300; ++i) {
      for (uint32_t corner = 0; corner < 3; ++corner) {
        const auto x = static_cast<int32_t>(numbers.number(-4096, 4096)),
                   y = static_cast<int32_t>(numbers.number(-4096, 4096)),
                   z = i % 3 == 0 ? -3000 : static_cast<int32_t>(numbers.number(-9000, -1500));
        chunk.vertices.push_back({{x, y, z}});
        chunk.indices.push_back(3 * i + corner);
      }
    }
    skeleton_.palette.push_back({255, 255, 255, 255});
    chunk_.emplace(chunk, skeleton_.palette);
    const BoxProjector projector(frame, raster_margins);
    const GeometryTerms terms(frame, projector);
    LatticePlacer placer(skeleton_);
    placer.begin(frame);
    std::vector<PlacedStretch> stretches;
    for (uint32_t i = 0; i < 300; ++i) {
      stretches.push_back({.rank = {i / 10, i},
                           .chunk = &*chunk_,
                           .first_triangle = i,
                           .triangle_count = 1,
                           .placed = placer.place(0, 0),
                           .pieces = std::span(&skeleton_.scene_nodes[0].box, 1)});
    }
    if (backwards) std::reverse(stretches.begin(), stretches.end());
    buffer.draw(terms, stretches);
  }

  VisibilityBuffer buffer;

 private:
  Skeleton skeleton_;
  std::optional<RasterChunk> chunk_;
};

double different_pixels(const Scene& one, const Scene& other) {
  double different = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const auto a = one.buffer.triangle(x, y), b = other.buffer.triangle(x, y);
      const bool same = a.has_value() == b.has_value() && (!a || a->range->rank == b->range->rank);
      different += !same || one.buffer.depth(x, y) != other.buffer.depth(x, y);
    }
  }
  return different;
}

double pixels_that_depend_on_order() { return different_pixels(Scene(false), Scene(true)); }

double pixels_that_depend_on_vectors() {
  const Scene with_vectors(false);
  const auto forced = forced_instruction_set();
  force_instruction_set(InstructionSet::scalar);
  const Scene without(false);
  force_instruction_set(forced);
  return different_pixels(with_vectors, without);
}

/// Rectangles on pixel borders, a third of them at the very depth that stands at one of their pixels: those
/// in front somewhere that are called hidden.
double hidden_in_front() {
  Numbers numbers;
  const Scene scene(false);
  double wrong = 0;
  for (int i = 0; i < 1000; ++i) {
    const int x0 = static_cast<int>(numbers.number(0, side - 20)),
              y0 = static_cast<int>(numbers.number(0, side - 20));
    const int x1 = x0 + 1 + static_cast<int>(numbers.number(0, 16)),
              y1 = y0 + 1 + static_cast<int>(numbers.number(0, 16));
    const auto device = [](int pixel) { return 2 * static_cast<float>(pixel) / side - 1; };
    ScreenRectangle rectangle{device(x0), device(y0), device(x1), device(y1), {}, {}};
    rectangle.planes[0].middle =
        i % 3 == 0 ? scene.buffer.depth(x0, y0) : static_cast<float>(numbers.number(0, 0.008));
    bool shows = false;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) shows = shows || rectangle.planes[0].middle >= scene.buffer.depth(x, y);
    }
    wrong += shows && count_pixels(scene.buffer, rectangle, false, 1) == 0;
  }
  return wrong;
}

[[gnu::noinline]] RasterCertificate measure() {
  RasterCertificate certificate;
  certificate.claimed_subpixel_bits = subpixel_bits;
  const auto add = [&](const char* name, double value, double margin, const char* unit) {
    certificate.findings.push_back({name, fmt::format("{:.3g}", value), value, margin, unit});
  };
  add("an edge snaps by at most", snapping(), raster_margins.outline, "pixels");
  add("pixels of shared edges not drawn exactly once", fill_rule(), 0, "pixels");
  add("depth is off by at most", depth_rounding(), share_of_depth / 2, "of itself");
  add("pixels that another order of drawing changes", pixels_that_depend_on_order(), 0, "pixels");
  add("pixels that vectors of this processor change", pixels_that_depend_on_vectors(), 0, "pixels");
  add("boxes in front that the test calls hidden", hidden_in_front(), 0, "of 1000");
  return certificate;
}

}  // namespace

RasterCertificate certify_raster() {
  const FloatState state;
  return measure();
}

}  // namespace triptych
