// The selection, as lines over a picture.
#pragma once

#include "view/overlay.hpp"
#include "view/selection.hpp"
#include "view/snap.hpp"

#include <vector>

namespace triptych {

class SelectionOutline {
 public:
  /// Of what is selected at full detail: its creases, and where it turns away from the eye. Of more than
  /// `most_triangles`, or of what is only known as an inner scene node, the box. Error for a damaged chunk.
  SelectionOutline(const Skeleton& skeleton, ChunkShelf& chunks, Selector& selector,
                   const Selection& selection);

  void draw(Overlay& overlay, const View& view) const;
  size_t edge_count() const { return edges_.size(); }

  static constexpr size_t most_triangles = 200'000;

 private:
  Box box_;
  std::vector<FeatureEdge> edges_;
};

}  // namespace triptych
