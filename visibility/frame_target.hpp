// The seam to what a device draws into: one target is begun, drawn into, tested against and finished, frame
// by frame.
#pragma once

#include "lod/frame_view.hpp"
#include "visibility/effect_use.hpp"
#include "visibility/occlusion_tester.hpp"
#include "visibility/screen_lines.hpp"
#include "visibility/visible_set.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// What a target keeps of what is drawn: always depth, and colours or the ids of drawables as well.
enum class TargetKind { color, item, depth_only, color_and_item };

/// A picture, or a depth alone, of width × height pixels. Rows of what is read back go from bottom to top.
/// All targets of one device share one vertex stage, and at equal depth the lower draw rank wins: by itself
/// (Device::order_matters() is false), or because what was drawn first stays and is drawn in draw rank order.
class FrameTarget : public OcclusionTester {
 public:
  virtual int width() const = 0;
  virtual int height() const = 0;
  virtual TargetKind kind() const = 0;

  /// A new frame: depth to 0 (infinitely far), colours to the background, no items. The viewport of the view
  /// must be of the target's size: Error (place: frame target) otherwise.
  virtual void begin(const FrameView& view) = 0;
  // draw() and test() come from OcclusionTester. Chunks that are not resident are requested from the
  // device's residency; Error for a damaged chunk, or where the device has no memory left.

  /// Waits until everything is drawn, so that a wall clock can time it.
  virtual void finish() = 0;
  /// Triangles that were drawn since begin().
  virtual uint64_t drawn_triangles() const = 0;

  /// Lines over whatever stands in a colour target, without a depth test.
  virtual void draw_lines(std::span<const ScreenLine> lines) = 0;

  /// width × height × RGBA bytes, of a target with colours.
  virtual std::vector<uint8_t> read_colors() const = 0;
  /// The same without a copy, good until the next call of anything else; empty where they are not in this
  /// process's memory, but on a graphics card.
  virtual std::span<const uint8_t> colors_in_memory() const { return {}; }
  /// width × height of drawable id + 1, 0 where nothing is, at that sample of each pixel, counted as
  /// sample_places() of the view's samples are; of a target with items.
  virtual std::vector<uint32_t> read_items(uint32_t sample = 0) const = 0;
  /// The drawables of which something transparent shows, at any sample of a pixel; of a target with colours
  /// or items. Reading items does not say: what is transparent has none.
  virtual VisibleSet transparent_owners() const { return {}; }
  /// Effects that took part in the picture, of a target with colours: known when it has been made.
  virtual std::span<const EffectUse> effects() const { return {}; }
  /// Copies the colours to the window whose context is current in this thread, of window_width ×
  /// window_height pixels: as much as fits; the rest is background. False, and nothing is done, where the
  /// target is not OpenGL's: whoever has the window takes the colours.
  virtual bool copy_to_window(int window_width, int window_height) const = 0;
};

/// The drawables that own at least one pixel of an item buffer, as read_items() gives it.
VisibleSet owners(std::vector<uint32_t> items);
/// Those that own at least one of so many samples of a pixel of a target with items.
VisibleSet owners(const FrameTarget& target, uint32_t samples);

}  // namespace triptych
