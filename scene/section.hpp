// What is cut away to look inside: section planes and a box.
#pragma once

#include "scene/box.hpp"

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

namespace triptych {

/// Keeps the points p of model space with dot(normal, p) >= offset.
struct SectionPlane {
  glm::dvec3 normal{0, 0, 1};  ///< of length 1, towards what is kept
  double offset = 0;           ///< model units
  /// Of a point from the plane, positive on the side that is kept.
  double distance(const glm::dvec3& point) const { return glm::dot(normal, point) - offset; }
  bool operator==(const SectionPlane&) const = default;
};

/// Keeps what all its planes keep and its box holds; without either, everything.
class Section {
 public:
  static constexpr uint32_t max_planes = 6;
  static constexpr uint32_t max_sides = max_planes + 6;

  std::span<const SectionPlane> planes() const { return std::span(planes_).first(plane_count_); }
  const std::optional<Box>& box() const { return box_; }
  bool keeps_all() const { return plane_count_ == 0 && !box_; }

  /// Error (place) for a seventh plane, numbers that are not finite, and a normal of no length; the normal
  /// is brought to length 1, and the offset with it.
  void add_plane(const SectionPlane& plane, const std::string& place);
  /// In place of an earlier box. Error (place) for an empty one, and numbers that are not finite.
  void set_box(const Box& box, const std::string& place);
  void remove_plane(uint32_t index);
  void remove_box() { box_.reset(); }

  bool operator==(const Section&) const = default;

 private:
  std::array<SectionPlane, max_planes> planes_ = {};  ///< those behind the last one stay as by default
  uint32_t plane_count_ = 0;
  std::optional<Box> box_;
};

/// Its planes, and its box as six more.
class SectionSides {
 public:
  explicit SectionSides(const Section& section);
  std::span<const SectionPlane> all() const { return std::span(sides_).first(count_); }

 private:
  std::array<SectionPlane, Section::max_sides> sides_ = {};
  uint32_t count_ = 0;
};

}  // namespace triptych
