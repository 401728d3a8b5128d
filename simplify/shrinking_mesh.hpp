// A surface whose triangles are removed one by one: flat arrays, no half-edges, so it can be any surface.
#pragma once

#include "simplify/surface.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// A triangle of a star, turned so that the star's point is its first corner: (point, from, to).
struct Spoke {
  uint32_t triangle, from, to, material;
  double error;
};

class ShrinkingMesh {
 public:
  explicit ShrinkingMesh(const Surface& surface);

  struct Face {
    std::array<uint32_t, 3> corners;  ///< the first is `gone` if the triangle was removed
    uint32_t material;                ///< where corners have colours, the chart (simplify/color_charts.hpp)
    double error;                     ///< a bound of its points' distance from the source
  };
  static constexpr uint32_t gone = 0xffffffffu;

  size_t triangle_count() const { return alive_; }
  const glm::ivec3& point(uint32_t index) const { return points_[index]; }
  /// All triangles, removed ones included.
  size_t face_count() const { return faces_.size(); }
  Face& face(uint32_t index) { return faces_[index]; }
  const Face& face(uint32_t index) const { return faces_[index]; }
  /// Whether corners have colours or places on textures, and those of a triangle.
  bool has_colors() const { return !colors_.empty(); }
  const SurfaceCorners& colors(uint32_t triangle) const { return colors_[triangle]; }
  /// Whether two triangles that share the edge between the points have the same places on a texture there.
  bool is_textured_across(uint32_t triangle, uint32_t other, uint32_t point, uint32_t end) const;
  /// Of the corner that is at the point.
  void set_color(uint32_t triangle, uint32_t point, const SurfaceCorner& color);

  /// How many triangles hold the point.
  size_t degree(uint32_t point) const { return slots_[point].alive; }
  /// The triangles that hold the point, and no others; valid until something is removed or moved.
  std::span<const uint32_t> star(uint32_t point);
  /// The same as spokes.
  void star(uint32_t point, std::vector<Spoke>& spokes);

  void remove(uint32_t triangle);
  /// In the triangles, all of which have the corner `from`, replaces it by `to`.
  void move(std::span<const uint32_t> triangles, uint32_t from, uint32_t to);

  /// What is left; sources: indices into the points that this mesh began with.
  Piece piece() const;
  /// For each triangle of that piece its error.
  std::vector<double> errors() const;

 private:
  struct Slot {
    uint32_t first, count, capacity, alive;
  };
  void make_room(uint32_t point, uint32_t added, Slot& left);
  void pack();

  std::vector<glm::ivec3> points_;
  std::vector<Face> faces_;
  std::vector<SurfaceCorners> colors_;     ///< for each face; empty if the surface has none
  std::vector<uint32_t> chart_materials_;  ///< for each chart its material
  /// For each point its triangles in places_, the first `count`, gone ones among them.
  std::vector<Slot> slots_;
  std::vector<uint32_t> places_;
  size_t alive_ = 0, packed_size_ = 0;
};

}  // namespace triptych
