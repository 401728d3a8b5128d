// The seam to a representation: from an entry of the cut to what is drawn for it.
#pragma once

#include "lod/frame_view.hpp"
#include "lod/hierarchy.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// A range of a chunk's triangles under a transform, in one draw.
struct DrawItem {
  DrawableId drawable = no_id;
  uint32_t chunk = 0;
  uint32_t transform = 0;                     ///< index into Skeleton::transforms
  uint32_t first_index = 0, index_count = 0;  ///< of the chunk's indices
  std::span<const LatticeBox> pieces;         ///< one box per piece, which its fragments are held to
};

/// How the geometry of a drawable gets finer and coarser. The cut has chosen the drawable; what is drawn
/// for it keeps the drawable's error bound and stays in its boxes, whatever the representation does.
class Representation {
 public:
  virtual ~Representation() = default;

  /// As reports name it.
  virtual const std::string& name() const = 0;
  /// A new frame: refinement for this view may begin.
  virtual void begin(const FrameView& view) = 0;
  /// Appends what is drawn for the drawable in this frame, in a fixed order; the boxes are valid until the
  /// next frame.
  virtual void append(DrawableId id, std::vector<DrawItem>& items) = 0;
};

/// Static levels of detail: each drawable is its placements, whole, without those that are hidden.
class LevelsRepresentation final : public Representation {
 public:
  explicit LevelsRepresentation(const Hierarchy& hierarchy) : hierarchy_(hierarchy) {}

  const std::string& name() const override;
  void begin(const FrameView& view) override { view_ = view; }
  void append(DrawableId id, std::vector<DrawItem>& items) override;

 private:
  const Hierarchy& hierarchy_;
  std::optional<FrameView> view_;
};

}  // namespace triptych
