// The sides of a section over a picture: which fragments they keep, and where rays come in.
#pragma once

#include "lod/frame_view.hpp"
#include "scene/sample_places.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

namespace triptych {

/// Keeps fragments of depth d at the place (X, Y), pixels from the picture's lower left corner, with
/// ((x · X + y · Y) + at) + of_depth · d ≥ 0, in floats in this order: the distance from the side as a share
/// of the depth, or orthographic of the range of depths, and the tolerance of SectionSpace. In every
/// projection it is affine in X, Y and d.
struct PixelSide {
  float x = 0, y = 0, at = 0, of_depth = 0;
  /// Where it meets the ray, but for the term of depth.
  float along(float px, float py) const { return (x * px + y * py) + at; }
};

/// One frame's. A fragment is kept or not by where it is drawn, and its depth stays what it was: so what a
/// section leaves is a subset of the fragments without it, and every bound of those holds.
class PixelSides {
 public:
  /// Pixel centres lie at this sample of each pixel.
  explicit PixelSides(const FrameView& view, const SamplePlace& place = {});

  std::span<const PixelSide> all() const { return std::span(sides_).first(count_); }
  /// Eye space, length 1, towards what is kept.
  const glm::vec3& normal(size_t side) const { return normals_[side]; }

  /// Where the ray through a place comes into what all sides keep: at the side that it passes last.
  struct Entry {
    uint32_t side;
    float depth;
  };
  /// Nullopt where it begins there, at the near plane; without meaning where it never comes in.
  std::optional<Entry> entry(float px, float py) const;

 private:
  std::array<PixelSide, Section::max_sides> sides_;
  std::array<glm::vec3, Section::max_sides> normals_;
  size_t count_ = 0;
};

}  // namespace triptych
