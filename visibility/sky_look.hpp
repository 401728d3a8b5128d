// What the sky looks like: a gradient from the horizon to the zenith, the ground below, the sun in it.
#pragma once

#include "lod/frame_view.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace triptych {

/// Whether a frame shows it.
inline bool shows_sky(const FrameState& state) { return state.sky.shown && state.effects.has(Effect::sky); }

/// The share of the sun's light that arrives, from 0 at the horizon to 1 at about 6 degrees and above.
/// sine: of the sun's altitude.
double sun_share(double sine);

/// Colours of one frame, as displayed (sRGB), 0 to 1. The ray through a pixel that shows nothing else has a
/// direction d (model space, y up, length 1). Where d.y ≥ 0 the colour is
///   horizon + (zenith − horizon) · (1 − (1 − d.y)⁴) + glow · max(0, d · sun)³²,
/// and `disc` where d · sun is at least the cosine of the sun's apparent radius; where d.y < 0, `ground`.
/// They are those of day, of a sun on the horizon and of night, mixed by the sine of its altitude.
struct SkyLook {
  explicit SkyLook(const FrameView& view);

  /// Of a pixel's centre, counted from the lower left corner.
  std::array<uint8_t, 4> at(int32_t x, int32_t y) const;

  glm::vec3 zenith, horizon, ground, glow;
  glm::vec3 sun;  ///< to it, model space
  /// The ray of a pixel's centre: corner + x · right + y · up, model space, of no certain length.
  glm::vec3 corner, right, up;
  static constexpr glm::vec3 disc{1.0f, 0.98f, 0.90f};
  /// Of 0.267 degrees.
  static constexpr float disc_cosine = 0.99998914f;
};

}  // namespace triptych
