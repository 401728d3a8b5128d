// How every device shades: one light, flat faces, both sides lit, since CAD models do not agree on which side
// is out.
#pragma once

#include "lod/frame_view.hpp"
#include "visibility/sky_look.hpp"

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace triptych {

/// A face of base colour c with the unit normal n (eye space, either side) is
/// c · (ambient + diffuse · |n · light| + headlight · |n.z|).
inline constexpr float ambient_light = 0.42f, diffuse_light = 0.38f, head_light = 0.20f;

/// What pixels without geometry show; red, green, blue, alpha, and the same from 0 to 1.
inline constexpr std::array<uint8_t, 4> background_bytes = {219, 230, 242, 255};
inline constexpr float background_color[4] = {219 / 255.0f, 230 / 255.0f, 242 / 255.0f, 1};

/// The direction to the light: in model space, and in eye space. Where the frame shows the sky that is the
/// sun, with a length of its share of light: less than 1 near the horizon, 0 below (sun_share()).
inline glm::dvec3 light_in_model() { return glm::normalize(glm::dvec3(0.35, 0.85, 0.40)); }
inline glm::vec3 light_direction(const FrameView& view) {
  if (!shows_sky(view.state)) return glm::vec3(view.rotation * light_in_model());
  const glm::dvec3& to_sun = view.state.sky.to_sun;
  return glm::vec3(view.rotation * (to_sun * sun_share(to_sun.y)));
}

}  // namespace triptych
