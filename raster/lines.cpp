#include "raster/lines.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace triptych {

namespace {

struct Segment {
  glm::vec2 from, to;  ///< pixels
};

/// Cut to 0 ≤ z ≤ w, |x| ≤ w, |y| ≤ w (Cyrus and Beck, Generalized two- and three-dimensional clipping,
/// 1978).
std::optional<Segment> cut(const ScreenLine& line, int width, int height) {
  const glm::vec4 planes[] = {{-1, 0, 0, 1}, {1, 0, 0, 1},  {0, -1, 0, 1},
                              {0, 1, 0, 1},  {0, 0, -1, 1}, {0, 0, 1, 0}};
  float first = 0, last = 1;
  for (const glm::vec4& plane : planes) {
    const float from = glm::dot(plane, line.from), to = glm::dot(plane, line.to);
    if (from < 0 && to < 0) return std::nullopt;
    if (from < 0) first = std::max(first, from / (from - to));
    if (to < 0) last = std::min(last, from / (from - to));
  }
  if (!(first <= last)) return std::nullopt;
  const auto pixel = [&](float share) {
    const glm::vec4 p = line.from + share * (line.to - line.from);
    return (glm::vec2(p) / p.w + 1.0f) * 0.5f * glm::vec2(width, height);
  };
  const Segment segment{pixel(first), pixel(last)};
  for (const glm::vec2& end : {segment.from, segment.to}) {
    if (!(std::isfinite(end.x) && std::isfinite(end.y))) return std::nullopt;
  }
  return segment;
}

}  // namespace

void draw_lines(std::span<const ScreenLine> lines, int width, int height, std::span<Rgba> picture) {
  for (const ScreenLine& line : lines) {
    const std::optional<Segment> segment = cut(line, width, height);
    if (!segment) continue;
    Rgba color;
    for (int i = 0; i < 4; ++i) {
      color[static_cast<size_t>(i)] =
          static_cast<uint8_t>(std::rint(std::clamp(line.color[i], 0.0f, 1.0f) * 255));
    }
    const glm::vec2 way = segment->to - segment->from;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::max(std::abs(way.x), std::abs(way.y)))));
    for (int i = 0; i <= steps; ++i) {
      const glm::vec2 at = segment->from + way * (static_cast<float>(i) / static_cast<float>(steps));
      const int x = std::clamp(static_cast<int>(at.x), 0, width - 1),
                y = std::clamp(static_cast<int>(at.y), 0, height - 1);
      picture[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] = color;
    }
  }
}

}  // namespace triptych
