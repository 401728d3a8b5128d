// The messages between the roles. Plain values; docs/protocol.md describes every byte.
#pragma once

#include "lod/draw_rank.hpp"
#include "protocol/role.hpp"
#include "scene/frame_state.hpp"
#include "visibility/device.hpp"
#include "visibility/visible_set.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace triptych {

inline constexpr uint32_t protocol_version = 12;

/// The first message on every socket, in both directions.
struct Hello {
  uint32_t version = protocol_version;
  Role role = Role::render;
  Channel channel = Channel::camera;
  Role called = Role::render;  ///< the role that the sender believes it is connected to
  uint64_t session = 0;        ///< a number chosen when the session starts: roles of two sessions do not mix
  uint64_t pack_hash = 0;      ///< the content hash of the pack that the role has opened
  DeviceNames device;
  std::string raster;  ///< the verdict of the sender's raster certificate: "exact" or "conservative"
  bool operator==(const Hello&) const = default;
};

/// From the render node to both switch nodes: the frame state of frame i.
struct CameraMessage {
  uint32_t frame = 0;
  FrameState state;
  bool last = false;  ///< no frame follows
  /// Not a frame of the session, but one to warm up with: switch nodes load its geometry and then send Ready.
  bool warm_up = false;
  bool operator==(const CameraMessage&) const = default;
};

/// From HC to the other two: a packet of the delta V(i−1) → V(i), in draw rank order from packet to packet.
struct DeltaMessage {
  uint32_t frame = 0;
  DrawRank watermark;              ///< every drawable of a lower draw rank is decided
  std::vector<std::byte> encoded;  ///< encode_delta(the packet's delta, V(i−1))
  bool operator==(const DeltaMessage&) const = default;
};

/// What HC did for the frame, and how long it took.
struct StageTimes {
  double hardware_cull_ms = 0;
  double hardware_cull_cpu_ms = 0;  ///< its processor time over the threads that the sender works with
  uint32_t queries = 0;             ///< boxes tested
  uint32_t cut_size = 0;            ///< drawables of cut i
  double sent_at_ms = 0;            ///< the sender's steady clock
  bool operator==(const StageTimes&) const = default;
};

/// From HC to the other two: the delta is complete. Receivers compare what they have with these.
struct Sentinel {
  uint32_t frame = 0;
  uint32_t visible = 0;             ///< drawables of V(i)
  uint32_t added = 0, removed = 0;  ///< over all packets of the frame
  uint64_t digest = 0;              ///< protocol/digest.hpp
  StageTimes times;
  bool operator==(const Sentinel&) const = default;
};

/// From a receiver whose digest of V(i) differs, to HC: send the whole set.
struct FullSetRequest {
  uint32_t frame = 0;
  bool operator==(const FullSetRequest&) const = default;
};

/// The answer: V(i) itself.
struct FullSet {
  uint32_t frame = 0;
  VisibleSet visible;
  bool operator==(const FullSet&) const = default;
};

/// From OR to the render node: what R(i+1) cost. It is sent before any message of frame i+1 from the same
/// node.
struct SwitchReport {
  uint32_t frame = 0;      ///< i, the frame in which it was drawn
  double began_at_ms = 0;  ///< the sender's steady clock, once camera i+1 had arrived
  double occlusion_representation_ms = 0;
  double occlusion_representation_cpu_ms = 0;  ///< its processor time over the threads of the sender
  double camera_waiting_ms = 0;                ///< for camera i+1, before it began
  double packets_waiting_ms = 0;               ///< for V(i), meanwhile
  uint32_t drawables = 0;                      ///< drawn into it
  uint64_t triangles = 0;
  bool operator==(const SwitchReport&) const = default;
};

/// The sender leaves. An empty reason: the session is over for all roles. Any other text says why only the
/// sender leaves, and can be shown to people.
struct Bye {
  std::string reason;
  bool operator==(const Bye&) const = default;
};

/// From a switch node to the render node: the warm-up of the frame is over, frames can come.
struct Ready {
  uint32_t frame = 0;
  bool operator==(const Ready&) const = default;
};

/// From the render node to a switch node: asks for its clock.
struct ClockRequest {
  uint32_t frame = 0;  ///< counts the requests
  bool operator==(const ClockRequest&) const = default;
};

/// The answer, sent at once.
struct ClockAnswer {
  uint32_t frame = 0;   ///< the request's
  double clock_ms = 0;  ///< the sender's steady clock
  bool operator==(const ClockAnswer&) const = default;
};

/// From the render node to both switch nodes, before the first camera of an epoch that names the set: the
/// objects that are hidden from this frame on.
struct HiddenSet {
  uint32_t frame = 0;
  std::vector<uint32_t> objects;  ///< ids of source objects, ascending
  bool operator==(const HiddenSet&) const = default;
};

using Message = std::variant<Hello, CameraMessage, DeltaMessage, Sentinel, FullSetRequest, FullSet,
                             SwitchReport, Bye, Ready, ClockRequest, ClockAnswer, HiddenSet>;

/// The frame that a message belongs to; 0 for Hello and Bye.
uint32_t frame_of(const Message& message);
/// "hello", "camera", "delta" …
const std::string& message_name(const Message& message);

}  // namespace triptych
