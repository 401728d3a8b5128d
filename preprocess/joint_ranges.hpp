// How the hierarchy splits what several files of a model hold together, so that the nodes of one file stay as
// they are when others change.
#pragma once

#include "preprocess/object_extent.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace triptych {

/// A range of objects of several files is cut in space until it has few leaves, then file from file; what is
/// of one file is split by itself. A cut is where the fewest binary digits say, between a quarter and three
/// quarters of the leaves: so it hardly ever moves when some of the objects do.
class JointRanges {
 public:
  using Range = std::span<uint32_t>;  ///< indices of objects

  /// leaves, files: as build_hierarchy(); all must outlive this.
  JointRanges(std::span<const ObjectExtent> objects, std::span<const uint64_t> leaves,
              std::span<const uint32_t> files);

  /// Whether the objects are of more than one file.
  bool is_joint(Range range) const;
  /// Two to four ranges of a joint one, which is put into their order.
  std::vector<Range> split(Range range) const;

 private:
  uint64_t leaves_of(uint32_t object) const { return leaves_.empty() ? 1 : leaves_[object]; }
  uint64_t leaves_of(Range range) const;
  /// Nothing where most of it is in one place, or one object.
  std::optional<std::vector<Range>> halves(Range range) const;
  std::vector<Range> by_file(Range range) const;

  std::span<const uint64_t> leaves_;
  std::span<const uint32_t> files_;
  std::vector<glm::dvec3> centers_;
};

}  // namespace triptych
