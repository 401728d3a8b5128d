// Draws a whole model with one call: what a program does that neither culls nor simplifies.
#pragma once

#include "lod/frame_view.hpp"
#include "scene/flat_model.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace triptych {

/// Pictures of one size, shaded as those of the device `gl`; of several samples a pixel, as it makes them:
/// all triangles once for each. There is nothing in it that only culling needs: no bounds of fragments, no
/// records of placements, positions in floats and in one static buffer.
class FlatModelPass {
 public:
  virtual ~FlatModelPass() = default;

  /// Draws the frame and waits until it is done. The viewport must be of the pass's size.
  virtual void draw(const FrameView& view) = 0;
  /// width × height × RGBA bytes, rows from bottom to top.
  virtual std::vector<uint8_t> read_colors() const = 0;
};

/// In the OpenGL context that is current in this thread; the model is copied to device memory. Error where
/// OpenGL has no room for it.
std::unique_ptr<FlatModelPass> make_gl_flat_model_pass(const FlatModel& model, int width, int height);

}  // namespace triptych
