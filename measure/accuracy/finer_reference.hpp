// The full detail between the middles of a picture's pixels.
#pragma once

#include "lod/frame_view.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace triptych {

/// The reference of one frame, drawn again with the camera shifted by parts of a pixel where that is asked
/// for: few frames need it.
class FinerReference {
 public:
  /// Draws the full detail: drawable id + 1 for each pixel, 0 for the background.
  using DrawItems = std::function<std::vector<uint32_t>(const FrameView&)>;
  struct Picture {
    FrameView view;
    std::vector<uint32_t> items;
  };
  /// How many there are: a thing that is a twentieth of a pixel wide and some pixels long is in some of them.
  static constexpr size_t shifts = 16;

  FinerReference(const FrameView& reference, DrawItems draw)
      : reference_(reference), draw_(std::move(draw)) {}

  /// Of the frame's size; drawn when they are first asked for.
  std::span<const Picture> pictures();

 private:
  FrameView reference_;
  DrawItems draw_;
  std::vector<Picture> pictures_;
};

}  // namespace triptych
