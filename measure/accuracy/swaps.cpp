#include "measure/accuracy/swaps.hpp"

#include "base/threads.hpp"

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

/// All that is within the radius of what is marked.
PixelMask widened(const PixelMask& mask, int radius) {
  PixelMask wide(mask.width, mask.height);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (!mask.at(x, y)) continue;
      const int right = std::min(x + radius, mask.width - 1), top = std::min(y + radius, mask.height - 1);
      for (int row = std::max(y - radius, 0); row <= top; ++row)
        for (int column = std::max(x - radius, 0); column <= right; ++column) wide.at(column, row) = 1;
    }
  }
  return wide;
}

}  // namespace

int search_radius(double pixel_error) { return static_cast<int>(std::ceil(std::min(pixel_error, 64.0))) + 1; }

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

uint64_t take_out_thin(const PackSurfaces& surfaces, FinerReference& finer,
                       std::span<const SurfacePixel> shown, PixelMask& swaps, int radius) {
  if (std::count(swaps.pixels.begin(), swaps.pixels.end(), 0) == std::ssize(swaps.pixels)) return 0;
  const PixelMask around = widened(swaps, radius);
  uint64_t taken = 0;
  for (const FinerReference::Picture& picture : finer.pictures()) {
    std::vector<uint32_t> items = picture.items;
    for (size_t i = 0; i < items.size(); ++i) {
      if (around.pixels[i] == 0) items[i] = 0;
    }
    const std::vector<SurfacePixel> surface = surface_pixels(surfaces, picture.view, items);
    const Reference between(surfaces.skeleton(), surface, swaps.width, swaps.height);
    for (int y = 0; y < swaps.height; ++y) {
      for (int x = 0; x < swaps.width; ++x) {
        if (swaps.at(x, y) == 0) continue;
        const size_t at = static_cast<size_t>(y) * static_cast<size_t>(swaps.width) + static_cast<size_t>(x);
        if (!between.shows_near(shown[at], x, y, radius)) continue;
        swaps.at(x, y) = 0;
        ++taken;
      }
    }
  }
  return taken;
}

}  // namespace triptych
