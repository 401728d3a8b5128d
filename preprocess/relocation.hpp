// A subtree's geometry in numbers of its own, so that it is the same bytes wherever in the model it is built,
// and whatever else there is.
#pragma once

#include "preprocess/leaf_span.hpp"
#include "scene/source_objects.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// The subtree's leaves count from its first one. The other leaves that its geometry names come right before
/// and behind them, without gaps, and so do the source objects that it names: of these numbers nothing but
/// the order counts, and that stays as it was.
class Relocation {
 public:
  /// The place of the subtree's first leaf in its own numbers: leaves before it have places too.
  static constexpr uint32_t own_first_place = 1u << 31;

  /// Of a subtree with the leaves from `first_place` up to, not including, `end_place`.
  Relocation(uint32_t first_place, uint32_t end_place) : first_place_(first_place), end_place_(end_place) {}
  /// Of all geometry of the subtree, in the model's numbers; before to_own().
  void take_in(std::span<const LeafSpan> spans, std::span<const SourceObjectId> objects);
  /// After the last take_in().
  void finish();

  void to_own(std::span<LeafSpan> spans, std::span<SourceObjectId> objects) const;
  void to_model(std::span<LeafSpan> spans, std::span<SourceObjectId> objects) const;
  /// Of triangles (preprocess/triangle_objects.hpp), as they are stored.
  std::vector<std::byte> to_model(std::span<const std::byte> triangle_objects) const;

 private:
  uint32_t own_place(uint32_t place) const;
  uint32_t model_place(uint32_t place) const;
  SourceObjectId model_object(SourceObjectId object) const;

  uint32_t first_place_, end_place_;
  std::vector<uint32_t> before_, behind_;  ///< places of other leaves; ascending
  std::vector<SourceObjectId> objects_;    ///< ascending
};

}  // namespace triptych
