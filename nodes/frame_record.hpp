// What one frame was and what it cost, drawn by a session or by one process.
#pragma once

#include "visibility/effect_use.hpp"
#include "visibility/visible_set.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// How a frame was steered to take no longer than a target (nodes/frame_steering.hpp).
struct SteeredFrame {
  double target_ms = 0;          ///< 0: it was not steered
  double asked_pixel_error = 0;  ///< the frame's own may be larger
  double pixel_error = 0;
  double aim_ms = 0;  ///< what it was to cost at most: less than the target where predictions are uncertain
  double predicted_ms = 0;   ///< what it was to cost, before it was drawn
  double cost_ms = 0;        ///< what it did, in the same measure
  double wall_ms = 0;        ///< from its request to its picture; session: from picture to picture
  bool undisturbed = false;  ///< whether that is the time of a quiet machine (base/spent_time.hpp)
  bool in_reach = true;      ///< false: no pixel error was large enough
};

/// Wall-clock times in milliseconds, each stage up to its glFinish.
struct FrameRecord {
  uint32_t number = 0;
  double frame_ms = 0;  ///< fallback: the stages' sum; session: from the last picture to this one
  double occlusion_representation_ms = 0, hardware_cull_ms = 0, render_ms = 0;
  double network_ms = 0;  ///< the render node's wait while HC's sentinel was on its way (on one machine)
  double waiting_ms = 0;  ///< all other waiting of the render node for messages
  double camera_to_image_ms = 0;  ///< from the camera's release to its picture
  /// Whether the parts below are known: of frames that all three roles took part in, except the first of an
  /// epoch. With R(i) and the hardware cull they add up to camera_to_image_ms. Clocks of other machines are
  /// off by their uncertainty.
  bool latency_known = false;
  double latency_waiting_ms = 0;  ///< of the camera for the switch node, and of that node for packets
  double latency_network_ms = 0;  ///< transfer of the camera and of the sentinel
  double latency_render_ms = 0;   ///< from when the sentinel was sent, without its transfer
  uint64_t cut_drawables = 0, drawn_triangles = 0, tests = 0;
  uint64_t added = 0, removed = 0;
  uint64_t level_changes = 0;  ///< of those, ids of scene nodes that stay visible at another level of detail
  uint64_t visible_count = 0;  ///< drawables of V(i)
  bool digest_mismatch = false;
  bool fallback = false;            ///< drawn by the render node by itself
  std::string lost{};               ///< on the first such frame: why
  VisibleSet visible{};             ///< V(i), where it is kept
  double pixel_error = 0;           ///< as it was drawn
  bool raised_for_memory = false;   ///< that is more than was asked, for want of memory
  uint64_t owed_drawables = 0;      ///< of those of V(i), drawn coarser since they were not read yet
  uint64_t left_out_drawables = 0;  ///< not drawn, or not all of them, since no pixel error leaves them room
  /// V(i) had no room: the render node drew the frame by itself, with a larger pixel error.
  bool redrawn = false;
  bool gets_finer = false;    ///< drawn once more: what it owes is being read, or there is room for more
  uint64_t picture_hash = 0;  ///< XXH3-64 of the picture's RGBA bytes, where it was read back
  SteeredFrame steered{};
  std::vector<EffectUse> effects{};  ///< those that ran, and what each cost
};

}  // namespace triptych
