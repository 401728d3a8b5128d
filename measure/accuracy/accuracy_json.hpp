// What measure_accuracy() found, as JSON and CSV, and in one sentence a setting.
#pragma once

#include "measure/accuracy/accuracy.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace triptych {

/// {"rows": [{pack, strategy, min_pixels, representation, device, size, pixel_error, build, build_seconds,
/// pack_bytes, promised {holes {limit_a_million, broken, says}, swaps}, frame_ms, cpu_ms,
/// stages_ms, drawn_triangles, drawables, wrong_pixel_share, deviation_px {median, p99, max}, hole_share,
/// hole_largest, slit_pixels, swap_share, swap_largest, swap_inner_pixels, swap_inner_share, thin_pixels,
/// cover_pixels, cover_kept, cover_grown, popping, flicker_share, shade and surface_shade {mean, p99}, rmse,
/// ssim, butteraugli, missed_triangle_share, untraced_share, compared_frames, says}], "promises",
/// "violations", "violated":
/// [{row, what, frame, drawable, place}], "advice": of accuracy_advice()}. Shares are of the picture's
/// pixels, those of holes and swaps of the reference's surface pixels, over the compared frames. What was not
/// measured is null.
nlohmann::json accuracy_json(const AccuracyResult& result);

/// The rows of accuracy_json(), one a line under a line of names; figures within a figure are named with a
/// dot.
std::string accuracy_csv(const nlohmann::json& report);

}  // namespace triptych
