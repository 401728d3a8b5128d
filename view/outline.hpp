// The selection, as lines over a picture.
#pragma once

#include "view/overlay.hpp"
#include "view/selection.hpp"
#include "view/snap.hpp"

#include <vector>

namespace triptych {

class SelectionOutline {
 public:
  /// Of what is selected at full detail: its creases, and where it turns away from the eye. Of what has more
  /// than `most_triangles`, of the rest where all of it has so many, and of what is only known as an inner
  /// scene node, the boxes. What moves is where it is in the frame. Error for a damaged chunk.
  SelectionOutline(const Skeleton& skeleton, ChunkShelf& chunks, Selector& selector,
                   const std::vector<Selection>& selected, const FrameState& frame);
  /// Whether it is where the selection is in this frame.
  bool is_of(const Skeleton& skeleton, const FrameState& frame) const {
    return poses_of(skeleton, frame) == poses_;
  }

  /// Without what the frame hides: that would be around nothing.
  void draw(Overlay& overlay, const FrameState& frame) const;

  static constexpr size_t most_triangles = 200'000;

 private:
  /// Of one that is selected.
  struct Piece {
    SourceObjectId object = no_id;
    Box box;
    std::vector<FeatureEdge> edges;  ///< none where the box is drawn
  };
  std::vector<Piece> pieces_;
  std::shared_ptr<const Poses> poses_;  ///< null where nothing moves
};

}  // namespace triptych
