// Edges of what one sample of each pixel shows.
#pragma once

#include "raster/triangle_shader.hpp"
#include "scene/sample_places.hpp"
#include "visibility/edge_rule.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// Keeps from row to row what it has found; for one thread. The plane and the rule must outlive it.
class EdgeMarker {
 public:
  EdgeMarker(const VisibilityBuffer& plane, const FrameView& view, const EdgeRule& rule,
             const SamplePlace& place);

  /// Draws the edges over the colours of a row's samples. Rows come from bottom to top.
  void draw(int32_t y, Rgba* row);

 private:
  static constexpr uint32_t count = 1024;
  struct Face {
    uint32_t slot;
    glm::vec3 normal;
    bool capped;  ///< Caps::show()
  };

  EdgeOwner between(int32_t x, int32_t y, int32_t other_x, int32_t other_y);
  const Face& face(uint32_t slot);
  SurfacePoint point(int32_t x, int32_t y);
  glm::vec2 at(int32_t x, int32_t y) const;
  /// Between each pixel of a row and the one above; no edges below and above the picture.
  void compare_upwards(int32_t y, std::vector<EdgeOwner>& owners);

  const VisibilityBuffer* plane_;
  const EdgeRule* rule_;
  Caps caps_;
  glm::vec2 centre_;              ///< of pixel (0, 0)
  int32_t next_row_ = -1;         ///< that `below_` is of
  std::vector<EdgeOwner> below_;  ///< between the row and the one below, pixel by pixel
  std::vector<EdgeOwner> above_;
  std::vector<Face> faces_;  ///< that were looked at a short while ago
};

}  // namespace triptych
