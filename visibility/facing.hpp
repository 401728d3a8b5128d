// Where backs of outward triangles (Chunk::outward) cannot be seen.
#pragma once

#include "lod/frame_view.hpp"

#include <cstdint>
#include <span>

namespace triptych {

/// How the fronts of a placed chunk's outward triangles go round in the window, if their backs may be left
/// out: 1 counter-clockwise, −1 clockwise, as under a transform that mirrors. 0 where backs may show, because
/// the near plane reaches one of the boxes that hold the chunk, or a section may cut one of them. transform:
/// the chunk's placement.
int32_t outward_front(const FrameView& view, const Affine& transform, std::span<const LatticeBox> boxes);

}  // namespace triptych
