// What is wrong with the pictures of one setting, frame by frame added up.
#pragma once

#include "measure/accuracy/cover.hpp"
#include "measure/accuracy/finer_reference.hpp"
#include "measure/accuracy/patches.hpp"
#include "measure/accuracy/pixel_deviation.hpp"
#include "measure/accuracy/shade_difference.hpp"
#include "measure/accuracy/surface_pixels.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace triptych {

/// A picture of one view, as it was drawn and as it was looked at.
struct ShownPicture {
  std::vector<uint8_t> colors;        ///< width × height × RGBA bytes, rows from bottom to top
  std::vector<uint32_t> items;        ///< drawable id + 1 at each pixel's centre, 0 for the background
  std::vector<SurfacePixel> surface;  ///< there, by rays
};

/// The colours of successive frames.
struct RecentColors {
  std::vector<uint8_t> before_last, last, current;
  void push(std::vector<uint8_t> colors) {
    before_last = std::move(last);
    last = std::move(current);
    current = std::move(colors);
  }
  void clear() { before_last.clear(), last.clear(), current.clear(); }
};

/// Where something is worst, with both pictures there.
struct WorstPatch {
  uint64_t pixels = 0;
  uint32_t frame = 0;
  int left = 0, bottom = 0, right = 0, top = 0;  ///< pixels of the picture
  int width = 0, height = 0;
  std::vector<uint8_t> reference, shown;  ///< whole pictures
  /// One of its pixels and what is there: the surface that a hole is in, or that is swapped in; its pixels
  /// are those of the patch.
  PointDeviation at{};
};

struct WorstDeviation {
  PointDeviation point{};
  uint32_t frame = 0;
};

/// What one frame's picture was found to be.
struct PictureMeasures {
  uint32_t frame = 0;
  int width = 0, height = 0;
  uint64_t surface_pixels = 0;  ///< of the reference
  uint64_t wrong_pixels = 0, untraced_pixels = 0;
  uint64_t slit_pixels = 0;  ///< of take_out_slits()
  uint64_t thin_pixels = 0;  ///< of take_out_thin()
  double squared_error = 0, ssim = 1;
  ShadeDifferences shades{}, surface_shades{};  ///< inside smooth surfaces; away from edges
  Patches holes{}, swaps{}, inner_swaps{};
  /// WorstPatch::at of the largest ones.
  PointDeviation hole_at{}, swap_at{}, inner_swap_at{};
  std::vector<PointDeviation> deviations{};
  std::optional<double> popping{};              ///< where the frame before is known
  std::optional<uint64_t> flickering_pixels{};  ///< where two are
  std::optional<CoverChange> cover{};           ///< where the camera was shifted
  std::optional<double> butteraugli{};
};

/// What the pictures of one frame at one pixel error are measured with.
struct PictureGround {
  const Cut& cut;
  std::span<const size_t> pixels;  ///< of the picture: where distances are measured
  FinerReference& finer;
};

/// All but popping, flicker, cover and butteraugli.
PictureMeasures measure_picture(const PackSurfaces& surfaces, const FrameView& view, uint32_t frame,
                                const ShownPicture& reference, const ShownPicture& shown,
                                const PictureGround& ground);

class PictureTally {
 public:
  /// The pictures are kept where a patch is the worst one yet.
  void add(const PictureMeasures& measures, const std::vector<uint8_t>& reference,
           const std::vector<uint8_t>& shown);

  size_t frames() const { return frames_; }
  double share_of_pixels(uint64_t count) const;
  double share_of_surface(uint64_t count) const;

  uint64_t wrong_pixels = 0, untraced_pixels = 0, hole_pixels = 0, slit_pixels = 0, swap_pixels = 0,
           thin_pixels = 0;
  uint64_t inner_swap_pixels = 0;  ///< of those the ones away from edges
  WorstPatch hole, swap, inner_swap;
  std::vector<float> deviations;  ///< pixels
  WorstDeviation worst_deviation;
  WorstPatch deviation_patch;  ///< around the worst one
  ShadeDifferences shades, surface_shades;
  double rmse() const;
  double ssim() const { return mean(ssim_, frames_).value_or(1); }
  /// Nullopt where nothing was measured.
  std::optional<double> popping() const { return mean(popping_, popping_frames_); }
  std::optional<double> flicker_share() const;
  std::optional<double> butteraugli() const { return mean(butteraugli_, butteraugli_frames_); }
  /// Pixels of small objects in the reference, over frames and shifts.
  double cover_pixels() const { return cover_ ? cover_->reference : 0; }
  std::optional<double> cover_kept() const;
  std::optional<double> cover_grown() const;

 private:
  static std::optional<double> mean(double sum, size_t count) {
    return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
  }

  size_t frames_ = 0, popping_frames_ = 0, butteraugli_frames_ = 0;
  uint64_t pixels_ = 0, surface_pixels_ = 0, flickering_ = 0, flicker_pixels_ = 0;
  double squared_error_ = 0, ssim_ = 0, popping_ = 0, butteraugli_ = 0;
  std::optional<CoverChange> cover_;
};

}  // namespace triptych
