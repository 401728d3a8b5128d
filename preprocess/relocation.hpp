// A subtree's geometry in numbers of its own, so that it is the same bytes wherever in the model it is built.
#pragma once

#include "preprocess/leaf_span.hpp"
#include "scene/source_objects.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Leaves count from the subtree's first one, source objects from the least one that its geometry names. What
/// is only compared by its order stays as it was.
class Relocation {
 public:
  /// The place of the subtree's first leaf in its own numbers: leaves before it have places too.
  static constexpr uint32_t own_first_place = 1u << 31;

  /// Places of leaves are below 2^31.
  explicit Relocation(uint32_t first_place) : first_place_(first_place) {}
  /// Of all geometry of the subtree, in the model's numbers; before to_own().
  void take_in(std::span<const SourceObjectId> objects);

  void to_own(std::span<LeafSpan> spans, std::span<SourceObjectId> objects) const;
  void to_model(std::span<LeafSpan> spans, std::span<SourceObjectId> objects) const;
  /// Of triangles (preprocess/triangle_objects.hpp), as they are stored.
  std::vector<std::byte> to_model(std::span<const std::byte> triangle_objects) const;

 private:
  uint32_t first_place_;
  SourceObjectId first_object_ = no_id;  ///< that of none, until there are any
};

}  // namespace triptych
