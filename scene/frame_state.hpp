// The frame state: the part of a frame's request that all who draw or cull it must agree on.
#pragma once

#include "scene/camera.hpp"
#include "scene/effects.hpp"
#include "scene/hiding.hpp"
#include "scene/section.hpp"
#include "scene/sky.hpp"

#include <cstdint>

namespace triptych {

/// What a frame's cut, culling and picture are functions of, beside the pack. The Camera message carries it,
/// the digest covers it, and nothing else that changes from frame to frame may change what is drawn. Later
/// fields are added here, in protocol/message_bodies.cpp,
/// protocol/digest.cpp and docs/protocol.md, and nowhere else.
struct FrameState {
  View view;               ///< camera and viewport
  double pixel_error = 1;  ///< pixels; 0 asks for full detail
  uint32_t samples = 1;    ///< of each pixel: 1, 4, 8 or 16 (scene/sample_places.hpp)
  bool edges = false;      ///< drawn as lines (visibility/edge_rule.hpp); changes colours, nothing else
  Section section = {};    ///< what lies outside of it is not there: it neither shows nor hides anything
  Hiding hiding = {};      ///< objects that are not there either (scene/hidden_objects.hpp)
  /// Those that the model is drawn with where it calls for them.
  Effects effects = Effects::all();
  double time = 0;  ///< seconds, of what moves (scene/motion.hpp)
  Sky sky = {};     ///< the sun's light, and what is behind everything
  bool operator==(const FrameState&) const = default;
};

/// A frame as the render node requests it.
struct FrameRequest {
  uint32_t number = 0;
  FrameState state = {};
};

}  // namespace triptych
