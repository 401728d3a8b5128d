// Window coordinates of the rasteriser: how a position in clip space becomes a place on the grid of
// sub-pixels.
#pragma once

#include "scene/sample_places.hpp"
#include "visibility/device_margins.hpp"
#include "visibility/vertex_terms.hpp"

#include <cmath>
#include <cstdint>
#include <glm/vec4.hpp>

namespace triptych {

inline constexpr int subpixel_bits = 8;
inline constexpr int32_t subpixels = 1 << subpixel_bits;  ///< a pixel's; centres lie at half of it
/// Vertices further than this from the middle of the picture, in sub-pixels, are clipped: 16,384 pixels,
/// twice as far as the edge of the largest picture, and floats still tell a quarter of a sub-pixel apart.
inline constexpr int32_t guard_band = 1 << 22;
inline constexpr int max_picture_side = 16384;

/// A vertex is moved by half a sub-pixel at most, and floats add a quarter of one in the largest picture:
/// 0.003 pixels. Rounding in the vertex stage is up to 2.6 times its bound (visibility/screen_bounds.cpp),
/// for which the outline has room up to 0.004 pixels of it, and four times the bound beyond.
/// docs/algorithms.md derives all of it.
inline constexpr DeviceMargins raster_margins{.outline = 1.0 / 64, .plane = 1.0 / 64, .roundings = 4};
/// What boxes are tested with: more than has to be, as much as OpenGL needs. What shows by a few pixels then
/// comes and goes less often, and sessions send fewer ids.
inline constexpr DeviceMargins steady_margins{};
static_assert(steady_margins.outline >= raster_margins.outline &&
              steady_margins.plane >= raster_margins.plane &&
              steady_margins.roundings >= raster_margins.roundings);

struct WindowVertex {
  int32_t x, y;  ///< sub-pixels from the lower left corner
  float depth;   ///< reversed
};

/// From clip space to window coordinates of a width × height picture; pixel centres lie at this sample of
/// each pixel.
class WindowTransform {
 public:
  WindowTransform() = default;
  WindowTransform(int width, int height, const SamplePlace& place = {})
      : scale_x_(static_cast<float>(width) * (subpixels / 2)),
        scale_y_(static_cast<float>(height) * (subpixels / 2)),
        guard_x_(guard_band / scale_x_),
        guard_y_(guard_band / scale_y_),
        middle_x_(width * (subpixels / 2) - place.x * (subpixels / 32)),
        middle_y_(height * (subpixels / 2) - place.y * (subpixels / 32)) {}

  /// How far inside a plane a position is, in no unit; negative outside, not a number where it has no place.
  enum class Plane { near, right, left, top, bottom };
  template <typename Position>  // of floats or doubles
  typename Position::value_type inside(const Position& clip, Plane plane) const {
    switch (plane) {
      case Plane::near:
        return clip.w - clip.z;
      case Plane::right:
        return guard_x_ * clip.w - clip.x;
      case Plane::left:
        return guard_x_ * clip.w + clip.x;
      case Plane::top:
        return guard_y_ * clip.w - clip.y;
      case Plane::bottom:
        break;
    }
    return guard_y_ * clip.w + clip.y;
  }
  bool is_inside(const glm::vec4& clip) const {
    return inside(clip, Plane::near) >= 0 && inside(clip, Plane::right) >= 0 &&
           inside(clip, Plane::left) >= 0 && inside(clip, Plane::top) >= 0 &&
           inside(clip, Plane::bottom) >= 0;
  }

  /// What |x| and |y| are at most within the guard band, as a share of w.
  float guard_x() const { return guard_x_; }
  float guard_y() const { return guard_y_; }
  /// From clip space, divided by w, to sub-pixels from the middle; and where that is.
  float scale_x() const { return scale_x_; }
  float scale_y() const { return scale_y_; }
  int32_t middle_x() const { return middle_x_; }
  int32_t middle_y() const { return middle_y_; }

  /// Of a position that is inside.
  WindowVertex apply(const glm::vec4& clip) const {
    const float over_w = 1.0f / clip.w;
    const float x = (clip.x * over_w) * scale_x_, y = (clip.y * over_w) * scale_y_;
    return {static_cast<int32_t>(std::rint(x)) + middle_x_, static_cast<int32_t>(std::rint(y)) + middle_y_,
            clip.z * over_w};
  }

 private:
  float scale_x_ = 0, scale_y_ = 0;  ///< to sub-pixels
  float guard_x_ = 0, guard_y_ = 0;  ///< what |x| and |y| are at most, as a share of w
  int32_t middle_x_ = 0, middle_y_ = 0;
};

}  // namespace triptych
