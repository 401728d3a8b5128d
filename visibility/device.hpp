// The seam to a device: what draws and tests. OpenGL stands behind it (render/), or anything else that
// keeps the rules below.
#pragma once

#include "scene/geometry_use.hpp"
#include "visibility/frame_target.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace triptych {

/// How a device identifies itself. Pictures of two runs are claimed to be identical only where all of it
/// matches.
struct DeviceNames {
  std::string vendor, renderer, version;
  bool operator==(const DeviceNames&) const = default;
};

/// Draws drawables of one pack. Rules, each held by tests that any device can be put through:
///   - all its targets share one vertex stage and one rule of what is in front: what one target draws,
///     another can test against;
///   - fragments are held to DepthBound of their piece in every target, and its boxes are tested
///     non-strictly, with margins that cover its own rounding: a box whose content shows is never called
///     hidden;
///   - what is drawn is a function of the pack, the frame view and the drawables in their order, whatever was
///     drawn before.
///
/// For one thread.
class Device {
 public:
  virtual ~Device() = default;

  /// Targets live no longer than their device. Error where the device has no room for such a size.
  virtual std::unique_ptr<FrameTarget> make_target(TargetKind kind, int width, int height) = 0;
  virtual const DeviceNames& names() const = 0;
  /// Whether a picture depends on the order in which drawables are drawn, so that it must be draw rank order.
  /// Where it does not, what was drawn to test against may become the picture, and what was drawn already is
  /// not drawn again.
  virtual bool order_matters() const { return true; }
  /// Geometry takes no more device memory than this from the next view on: chunks that were not drawn for
  /// longest go. A view that needs more ends in NoRoom (scene/geometry_use.hpp), thrown by draw(); its
  /// targets are to be begun again then.
  virtual void set_geometry_cap(uint64_t bytes) = 0;
  /// From the next draw() on; at first draws wait, and refuse.
  virtual void set_missing(const MissingChunks& missing) = 0;
  virtual GeometryUse geometry_use() const = 0;
  /// Whether the chunk is in device memory.
  virtual bool has_chunk(uint32_t chunk) const = 0;
  /// Whether the chunk was found to be damaged and left out: it never comes.
  virtual bool is_damaged(uint32_t chunk) const = 0;
};

}  // namespace triptych
