#include "measure/accuracy/picture_tally.hpp"

#include "measure/accuracy/holes.hpp"
#include "measure/accuracy/picture_difference.hpp"
#include "measure/accuracy/reference_edges.hpp"
#include "measure/accuracy/swaps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace triptych {

namespace {

/// The pixel that a point of model space is in.
std::pair<int, int> pixel_of(const FrameView& view, const glm::dvec3& point) {
  const View& v = view.view();
  const glm::dvec3 eye = view.rotation * (point - v.camera.eye);
  const double depth = v.camera.orthographic() ? 1 : -eye.z;
  const auto clamped = [](double value, int end) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(end - 1)));
  };
  return {clamped((eye.x / depth - v.camera.left) * v.focal_x(), v.width),
          clamped((eye.y / depth - v.camera.bottom) * v.focal_y(), v.height)};
}

/// What a picture shows in the largest patch.
PointDeviation place_of(const Patches& patch, const std::vector<SurfacePixel>& surface, int width) {
  if (patch.largest == 0) return {};
  const SurfacePixel& pixel =
      surface[static_cast<size_t>(patch.y) * static_cast<size_t>(width) + static_cast<size_t>(patch.x)];
  return {static_cast<double>(patch.largest), pixel.drawable, pixel.point, patch.x, patch.y};
}

void keep_worst(WorstPatch& worst, const Patches& patch, const PointDeviation& at,
                const PictureMeasures& measures, const std::vector<uint8_t>& reference,
                const std::vector<uint8_t>& shown) {
  if (patch.largest <= worst.pixels) return;
  worst = {patch.largest,  measures.frame,  patch.left, patch.bottom, patch.right, patch.top,
           measures.width, measures.height, reference,  shown,        at};
}

}  // namespace

PictureMeasures measure_picture(const PackSurfaces& surfaces, const FrameView& view, uint32_t frame,
                                const ShownPicture& reference, const ShownPicture& shown,
                                const PictureGround& ground) {
  const int width = view.view().width, height = view.view().height;
  const int radius = search_radius(view.state.pixel_error);
  PictureMeasures measures{.frame = frame, .width = width, .height = height};
  for (const SurfacePixel& pixel : reference.surface) measures.surface_pixels += !pixel.background();
  for (const SurfacePixel& pixel : shown.surface)
    measures.untraced_pixels += !pixel.background() && !pixel.found;
  const PictureDifference difference = picture_difference(reference.colors, shown.colors, width, height);
  measures.wrong_pixels = difference.wrong_pixels;
  measures.squared_error = difference.squared_error;
  measures.ssim = difference.ssim;
  measures.shades =
      shade_differences(reference.surface, reference.colors, shown.surface, shown.colors, width, height);
  const PixelMask inside =
      away_from_edges(view, reference.surface, inside_surfaces(reference.surface, width, height), radius - 1);
  measures.surface_shades =
      shade_differences_in(inside, reference.surface, reference.colors, shown.surface, shown.colors);
  PixelMask holes = find_holes(reference.surface, shown.surface, width, height, radius);
  measures.slit_pixels = take_out_slits(surfaces, view, shown.surface, holes);
  measures.holes = find_patches(std::move(holes));
  PixelMask swaps = find_swaps(surfaces.skeleton(), reference.surface, shown.surface, width, height, radius);
  measures.thin_pixels = take_out_thin(surfaces, ground.finer, shown.surface, swaps, radius);
  measures.inner_swaps = find_patches(away_from_edges(view, reference.surface, swaps, radius - 1));
  measures.swaps = find_patches(std::move(swaps));
  measures.hole_at = place_of(measures.holes, reference.surface, width);
  measures.swap_at = place_of(measures.swaps, shown.surface, width);
  measures.inner_swap_at = place_of(measures.inner_swaps, shown.surface, width);
  measures.deviations = shown_deviations(surfaces, view, shown.surface, ground.pixels);
  const std::vector<PointDeviation> back =
      reference_deviations(surfaces, view, ground.cut, reference.surface, ground.pixels);
  measures.deviations.insert(measures.deviations.end(), back.begin(), back.end());
  for (PointDeviation& deviation : measures.deviations)
    std::tie(deviation.x, deviation.y) = pixel_of(view, deviation.place);
  return measures;
}

void PictureTally::add(const PictureMeasures& measures, const std::vector<uint8_t>& reference,
                       const std::vector<uint8_t>& shown) {
  ++frames_;
  const uint64_t pixels = static_cast<uint64_t>(measures.width) * static_cast<uint64_t>(measures.height);
  pixels_ += pixels;
  surface_pixels_ += measures.surface_pixels;
  wrong_pixels += measures.wrong_pixels;
  untraced_pixels += measures.untraced_pixels;
  hole_pixels += measures.holes.pixels;
  slit_pixels += measures.slit_pixels;
  thin_pixels += measures.thin_pixels;
  swap_pixels += measures.swaps.pixels;
  inner_swap_pixels += measures.inner_swaps.pixels;
  squared_error_ += measures.squared_error;
  ssim_ += measures.ssim;
  shades.add(measures.shades);
  surface_shades.add(measures.surface_shades);
  keep_worst(hole, measures.holes, measures.hole_at, measures, reference, shown);
  keep_worst(swap, measures.swaps, measures.swap_at, measures, reference, shown);
  keep_worst(inner_swap, measures.inner_swaps, measures.inner_swap_at, measures, reference, shown);
  for (const PointDeviation& point : measures.deviations) {
    deviations.push_back(static_cast<float>(point.pixels));
    if (point.pixels <= worst_deviation.point.pixels) continue;
    worst_deviation = {point, measures.frame};
  }
  if (worst_deviation.point.drawable != no_id && worst_deviation.frame == measures.frame) {
    const int x = worst_deviation.point.x, y = worst_deviation.point.y;
    deviation_patch = {1,         measures.frame, x, y, x + 1, y + 1, measures.width, measures.height,
                       reference, shown};
  }
  if (measures.popping) popping_ += *measures.popping, ++popping_frames_;
  if (measures.flickering_pixels) flickering_ += *measures.flickering_pixels, flicker_pixels_ += pixels;
  if (measures.butteraugli) butteraugli_ += *measures.butteraugli, ++butteraugli_frames_;
  if (measures.cover) {
    if (!cover_) cover_ = CoverChange();
    cover_->reference += measures.cover->reference;
    cover_->kept += measures.cover->kept;
    cover_->grown += measures.cover->grown;
  }
}

double PictureTally::share_of_pixels(uint64_t count) const {
  return pixels_ > 0 ? static_cast<double>(count) / static_cast<double>(pixels_) : 0;
}

double PictureTally::share_of_surface(uint64_t count) const {
  return surface_pixels_ > 0 ? static_cast<double>(count) / static_cast<double>(surface_pixels_) : 0;
}

double PictureTally::rmse() const {
  return pixels_ > 0 ? std::sqrt(squared_error_ / (3 * static_cast<double>(pixels_))) : 0;
}

std::optional<double> PictureTally::flicker_share() const {
  return mean(static_cast<double>(flickering_), flicker_pixels_);
}

std::optional<double> PictureTally::cover_kept() const {
  if (!cover_) return std::nullopt;
  return cover_->reference > 0 ? cover_->kept / cover_->reference : 1;
}

std::optional<double> PictureTally::cover_grown() const {
  if (!cover_) return std::nullopt;
  return cover_->reference > 0 ? cover_->grown / cover_->reference : 0;
}

}  // namespace triptych
