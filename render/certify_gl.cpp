#include "render/certify_gl.hpp"

#include "render/gl/raster_probe.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <random>

namespace triptych {

namespace {

constexpr int side = 256;  // small enough that pixels and 1/4096 of them are exact in floats

/// Random numbers, the same on every machine.
class RandomNumbers {
 public:
  float number(double lo, double hi) {
    return static_cast<float>(lo + (hi - lo) * (static_cast<double>(generator_()) * 0x1p-32));
  }

 private:
  std::mt19937 generator_{1};
};

float device(double pixel) { return static_cast<float>(2 * pixel / side - 1); }
float centre(int pixel) { return device(pixel + 0.5); }

/// Draws squares whose right or left edges pass the centre of a pixel by k/4096 pixels: the largest k that
/// makes no difference is how far snapping moves an edge.
double snapping() {
  RasterProbe probe(side, side);
  double furthest = 0;
  constexpr int steps = 1024;
  for (const bool right : {true, false}) {
    std::vector<ProbeVertex> vertices;
    for (int k = 0; k < steps; ++k) {
      const double x = 2 * (k % 128) + 0.5, y = 2 * (k / 128) + 0.5, past = (k + 1) / 4096.0;
      const double left_edge = right ? x - 0.4 : x - past, right_edge = right ? x + past : x + 0.4;
      append_rectangle(vertices, device(left_edge), device(y - 0.4), device(right_edge), device(y + 0.4),
                       0.5f);
    }
    const std::vector<float> counts = probe.count_fragments(vertices);
    for (int k = 0; k < steps; ++k) {
      const size_t pixel = static_cast<size_t>(2 * (k / 128) * side + 2 * (k % 128));
      if (counts[pixel] < 0.5f) furthest = std::max(furthest, (k + 1) / 4096.0);
    }
  }
  return furthest;
}

/// Draws a grid of triangles with random inner corners: how many pixels inside it are not drawn exactly once.
double fill_rule() {
  constexpr int cells = 24;
  RandomNumbers numbers;
  std::vector<ProbeVertex> corners;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      const bool inner = x > 0 && y > 0 && x < cells && y < cells;
      const float shake = inner ? 0.4f / cells : 0;  // small enough that triangles do not overlap
      corners.push_back({-1 + 2.0f * static_cast<float>(x) / cells + numbers.number(-shake, shake),
                         -1 + 2.0f * static_cast<float>(y) / cells + numbers.number(-shake, shake), 0.5f, 1});
    }
  }
  std::vector<ProbeVertex> vertices;
  for (size_t y = 0; y < cells; ++y) {
    for (size_t x = 0; x < cells; ++x) {
      const size_t a = y * (cells + 1) + x, b = a + 1, c = a + cells + 1, d = c + 1;
      for (const size_t i : {a, b, d, a, d, c}) vertices.push_back(corners[i]);
    }
  }
  const std::vector<float> counts = RasterProbe(side, side).count_fragments(vertices);
  return static_cast<double>(
      std::count_if(counts.begin(), counts.end(), [](float count) { return std::abs(count - 1) > 0.25f; }));
}

/// Draws planes at all slants, in perspective: the relative error of the depth buffer at pixel centres.
double depth_rounding() {
  RandomNumbers numbers;
  RasterProbe probe(side, side);
  double worst = 0;
  for (int round = 0; round < 12; ++round) {
    // near / w for a plane w = a x + b y + c over the picture.
    const double near = std::exp2(numbers.number(-12, 2)), c = near * std::exp2(numbers.number(1, 14));
    const double a = c * numbers.number(-0.45, 0.45), b = c * numbers.number(-0.45, 0.45);
    const auto vertex = [&](double x, double y) {
      const double w = 1 / ((1 + a / c * x + b / c * y) / c);
      return ProbeVertex{static_cast<float>(x * w), static_cast<float>(y * w), static_cast<float>(near),
                         static_cast<float>(w)};
    };
    const std::vector<float> depths = probe.depths(
        {vertex(-1, -1), vertex(1, -1), vertex(1, 1), vertex(-1, -1), vertex(1, 1), vertex(-1, 1)});
    for (int pixel = 0; pixel < side * side; ++pixel) {
      const double x = (2 * (pixel % side) + 1.0) / side - 1, y = (2 * (pixel / side) + 1.0) / side - 1;
      const double exact = near * (1 + a / c * x + b / c * y) / c;
      worst = std::max(worst, std::abs(depths[static_cast<size_t>(pixel)] - exact) / exact);
    }
  }
  return worst;
}

struct TestTruth {
  double hidden_by_queries = 0, hidden_by_storage = 0, equal_taken = 0;
};

/// Tests rectangles on pixel borders against depths that are read back: how many are called hidden although
/// they are somewhere in front of the depth or at exactly the depth.
TestTruth tests_against_readback() {
  RandomNumbers numbers;
  RasterProbe probe(side, side);
  std::vector<ProbeVertex> scene;
  for (int i = 0; i < 300; ++i) {
    const float x = numbers.number(-1, 0.8), y = numbers.number(-1, 0.8);
    for (int corner = 0; corner < 3; ++corner)
      scene.push_back({x + numbers.number(0, 0.5), y + numbers.number(0, 0.5), numbers.number(0.05, 0.9), 1});
  }
  const std::vector<float> depths = probe.depths(scene);
  std::vector<ScreenRectangle> rectangles;
  std::vector<bool> truth;
  for (int i = 0; i < 1000; ++i) {
    const int x0 = static_cast<int>(numbers.number(0, side - 20)),
              y0 = static_cast<int>(numbers.number(0, side - 20));
    const int x1 = x0 + 1 + static_cast<int>(numbers.number(0, 16)),
              y1 = y0 + 1 + static_cast<int>(numbers.number(0, 16));
    ScreenRectangle rectangle{device(x0), device(y0), device(x1), device(y1), {}, {}};
    DepthPlane& plane = rectangle.planes[0];
    // A third of them exactly at a depth of the buffer, a third sloping.
    plane.middle = i % 3 == 0 ? depths[static_cast<size_t>(y0 * side + x0)] : numbers.number(0.05f, 0.9f);
    if (i % 3 == 1) plane.slope = {numbers.number(-8, 8), numbers.number(-8, 8)};
    const float rounding = i % 3 == 1 ? static_cast<float>(17 * plane_rounding) : 0;
    bool shows = false;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const float depth = plane.at(centre(x), centre(y)) - rounding;
        shows = shows || (depth > 0 && depth >= depths[static_cast<size_t>(y * side + x)]);
      }
    }
    rectangles.push_back(rectangle);
    truth.push_back(shows);
  }
  TestTruth found;
  const std::vector<uint8_t> queries = probe.test_by_queries(rectangles),
                             storage = probe.test_by_storage(rectangles);
  for (size_t i = 0; i < truth.size(); ++i) {
    found.hidden_by_queries += truth[i] && queries[i] == 0;
    found.hidden_by_storage += truth[i] && storage[i] == 0;
  }
  found.equal_taken = static_cast<double>(probe.fragments_that_pass_again(scene));
  return found;
}

}  // namespace

RasterCertificate certify_gl() {
  RasterCertificate certificate;
  glGetIntegerv(GL_SUBPIXEL_BITS, &certificate.claimed_subpixel_bits);
  const auto add = [&](const char* name, double value, double margin, const char* unit) {
    certificate.findings.push_back({name, fmt::format("{:.3g}", value), value, margin, unit});
  };
  // What the margins of visibility/screen_bounds.cpp leave: 1 pixel less the 0.65 of the vertex stage, and
  // 2⁻¹⁴ of the depth less what the rounding of w takes.
  add("an edge snaps by at most", snapping(), 1.0 / 16, "pixels");
  add("pixels of shared edges not drawn exactly once", fill_rule(), 0, "pixels");
  add("interpolated depth is off by at most", depth_rounding(), 0x1p-15, "of itself");
  add("fragments on which two passes disagree", passes_that_disagree(), 0, "fragments");
  const TestTruth tests = tests_against_readback();
  add("boxes in front that a query calls hidden", tests.hidden_by_queries, 0, "of 1000");
  add("boxes in front that the storage test calls hidden", tests.hidden_by_storage, 0, "of 1000");
  add("fragments of equal depth that replace what stood there", tests.equal_taken, 0, "fragments");
  return certificate;
}

}  // namespace triptych
