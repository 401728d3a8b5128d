#include "measure/accuracy/holes_and_swaps.hpp"

#include "base/threads.hpp"
#include "measure/pixel_rays.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace triptych {

namespace {

/// Two base colours are about the same where no channel differs by more.
constexpr int same_color = 24;

bool about_same(const std::array<uint8_t, 4>& one, const std::array<uint8_t, 4>& other) {
  for (size_t channel = 0; channel < 3; ++channel) {
    if (std::abs(int{one[channel]} - int{other[channel]}) > same_color) return false;
  }
  return true;
}

/// Whether the leaf lies below the scene node, or is it. Parents have smaller ids.
bool is_below(const Skeleton& skeleton, SceneNodeId leaf, SceneNodeId node) {
  while (leaf != no_id && leaf > node) leaf = skeleton.scene_nodes[leaf].parent;
  return leaf == node;
}

class Reference {
 public:
  Reference(const Skeleton& skeleton, std::span<const SurfacePixel> pixels, int width, int height)
      : skeleton_(skeleton), pixels_(pixels), width_(width), height_(height) {}

  /// Whether it shows, within the radius of a pixel, what that pixel shows of a drawable. Where either
  /// surface is not known it counts as shown.
  bool shows_near(const SurfacePixel& shown, int x, int y, int radius) const {
    for (int ring = 0; ring <= radius; ++ring) {
      const int left = x - ring, right = x + ring;
      for (int row = std::max(y - ring, 0); row <= std::min(y + ring, height_ - 1); ++row) {
        const bool whole_row = row == y - ring || row == y + ring;
        const int step = whole_row || ring == 0 ? 1 : 2 * ring;
        for (int column = left; column <= right; column += step) {
          if (column >= 0 && column < width_ && matches(shown, column, row)) return true;
        }
      }
    }
    return false;
  }

 private:
  bool matches(const SurfacePixel& shown, int x, int y) const {
    const SurfacePixel& pixel =
        pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
    if (pixel.background()) return false;
    const SceneNodeId node = skeleton_.drawables[shown.drawable].scene_node;
    const SceneNodeId leaf = skeleton_.drawables[pixel.drawable].scene_node;
    return is_below(skeleton_, leaf, node) && (!pixel.found || about_same(pixel.color, shown.color));
  }

  const Skeleton& skeleton_;
  std::span<const SurfacePixel> pixels_;
  int width_, height_;
};

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

int search_radius(double pixel_error) { return static_cast<int>(std::ceil(std::min(pixel_error, 64.0))) + 1; }

PixelMask find_holes(std::span<const SurfacePixel> reference, std::span<const SurfacePixel> shown, int width,
                     int height, int radius) {
  PixelMask holes(width, height);
  // How many background pixels the reference has below and left of each corner.
  const auto across = static_cast<size_t>(width) + 1;
  std::vector<uint32_t> sums(across * (static_cast<size_t>(height) + 1), 0);
  const auto sum = [&](int x, int y) -> uint32_t& {
    return sums[static_cast<size_t>(y) * across + static_cast<size_t>(x)];
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const size_t at = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      sum(x + 1, y + 1) = sum(x, y + 1) + sum(x + 1, y) - sum(x, y) + (reference[at].background() ? 1 : 0);
    }
  }
  for (int y = radius; y < height - radius; ++y) {
    for (int x = radius; x < width - radius; ++x) {
      const size_t at = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      if (!shown[at].background()) continue;
      const int left = x - radius, right = x + radius + 1, bottom = y - radius, top = y + radius + 1;
      const uint32_t background = sum(right, top) - sum(left, top) - sum(right, bottom) + sum(left, bottom);
      holes.at(x, y) = background == 0;
    }
  }
  return holes;
}

uint64_t take_out_slits(const PackSurfaces& surfaces, const FrameView& view,
                        std::span<const SurfacePixel> shown, PixelMask& holes) {
  constexpr int beside = 2;  // pixels
  const PixelRays rays(view);
  uint64_t taken = 0;
  std::vector<DrawableId> around;
  for (int y = 0; y < holes.height; ++y) {
    for (int x = 0; x < holes.width; ++x) {
      if (holes.at(x, y) == 0) continue;
      around.clear();
      for (int row = std::max(y - beside, 0); row <= std::min(y + beside, holes.height - 1); ++row) {
        for (int column = std::max(x - beside, 0); column <= std::min(x + beside, holes.width - 1);
             ++column) {
          const SurfacePixel& pixel = shown[static_cast<size_t>(row) * static_cast<size_t>(holes.width) +
                                            static_cast<size_t>(column)];
          if (!pixel.background() && std::count(around.begin(), around.end(), pixel.drawable) == 0)
            around.push_back(pixel.drawable);
        }
      }
      const bool slit = std::any_of(around.begin(), around.end(),
                                    [&](DrawableId id) { return rays.hit(surfaces, id, x, y).has_value(); });
      if (!slit) continue;
      holes.at(x, y) = 0;
      ++taken;
    }
  }
  return taken;
}

PixelMask find_swaps(const Skeleton& skeleton, std::span<const SurfacePixel> reference,
                     std::span<const SurfacePixel> shown, int width, int height, int radius) {
  PixelMask swaps(width, height);
  const Reference full(skeleton, reference, width, height);
  parallel_for(static_cast<size_t>(height), [&](size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      const SurfacePixel& pixel = shown[row * static_cast<size_t>(width) + static_cast<size_t>(x)];
      swaps.at(x, y) = pixel.found && !full.shows_near(pixel, x, y, radius);
    }
  });
  return swaps;
}

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
