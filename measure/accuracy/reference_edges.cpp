#include "measure/accuracy/reference_edges.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

/// Where the reference's surface does not go on from one pixel to the next.
class StepFinder {
 public:
  StepFinder(const FrameView& view, std::span<const SurfacePixel> pixels, int width, int height)
      : pixels_(pixels),
        width_(width),
        height_(height),
        linear_(pixels.size(), 0),
        scales_(pixels.size(), 0) {
    const Camera& camera = view.view().camera;
    for (size_t i = 0; i < pixels.size(); ++i) {
      const double depth = -(view.rotation * (pixels[i].point - camera.eye)).z;
      if (!pixels[i].found || !(camera.orthographic() || depth > 0)) continue;
      linear_[i] = camera.orthographic() ? depth : 1 / depth;
      scales_[i] = view.focal_length * (camera.orthographic() ? 1 : depth);
    }
  }

  /// Whether there is one between a pixel and its neighbour on the right or above (dx, dy: 1, 0 or 0, 1).
  bool between(int x, int y, int dx, int dy) const {
    const SurfacePixel& one = at(x, y);
    const SurfacePixel& other = at(x + dx, y + dy);
    if (one.background() || other.background()) return one.background() != other.background();
    if (!one.found || !other.found) return false;
    return std::min(off(x, y, dx, dy), off(x + dx, y + dy, -dx, -dy)) > least_step;
  }

 private:
  static constexpr double least_step = 2;  // pixels

  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }
  const SurfacePixel& at(int x, int y) const { return pixels_[index(x, y)]; }
  /// How far the next pixel's surface is, in pixels there, from where this pixel's would go on, if it is as
  /// steep as it is from the pixel before to this one. On a plane the inverse of depth is linear.
  double off(int x, int y, int dx, int dy) const {
    const size_t here = index(x, y), next = index(x + dx, y + dy);
    double slope = 0;
    if (inside(x - dx, y - dy) && at(x - dx, y - dy).found)
      slope = linear_[here] - linear_[index(x - dx, y - dy)];
    return std::abs(linear_[next] - linear_[here] - slope) * scales_[next];
  }

  std::span<const SurfacePixel> pixels_;
  int width_, height_;
  std::vector<double> linear_;  ///< of each pixel's surface: what is linear in pixels on a plane
  std::vector<double> scales_;  ///< pixels a unit of it
};

}  // namespace

PixelMask away_from_edges(const FrameView& view, std::span<const SurfacePixel> reference, PixelMask mask,
                          int radius) {
  const StepFinder steps(view, reference, mask.width, mask.height);
  const auto near_edge = [&](int x, int y) {
    const int left = std::max(x - radius, 0), right = std::min(x + radius, mask.width - 1);
    const int bottom = std::max(y - radius, 0), top = std::min(y + radius, mask.height - 1);
    for (int row = bottom; row <= top; ++row) {
      for (int column = left; column <= right; ++column) {
        if (column < right && steps.between(column, row, 1, 0)) return true;
        if (row < top && steps.between(column, row, 0, 1)) return true;
      }
    }
    return false;
  };
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (mask.at(x, y) != 0 && near_edge(x, y)) mask.at(x, y) = 0;
    }
  }
  return mask;
}

}  // namespace triptych
