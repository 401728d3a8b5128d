#include "visibility/sky_look.hpp"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace triptych {

namespace {

struct Colors {
  glm::vec3 zenith, horizon, ground, glow;
};
constexpr Colors day = {
    {0.33f, 0.54f, 0.86f}, {0.80f, 0.88f, 0.95f}, {0.50f, 0.53f, 0.43f}, {0.22f, 0.20f, 0.14f}};
constexpr Colors dusk = {
    {0.24f, 0.31f, 0.50f}, {0.96f, 0.71f, 0.48f}, {0.27f, 0.27f, 0.23f}, {0.30f, 0.18f, 0.06f}};
constexpr Colors night = {
    {0.02f, 0.03f, 0.08f}, {0.06f, 0.08f, 0.14f}, {0.04f, 0.04f, 0.05f}, {0.0f, 0.0f, 0.0f}};

Colors mixed(const Colors& a, const Colors& b, float share) {
  const auto mix = [&](const glm::vec3& from, const glm::vec3& to) { return from + (to - from) * share; };
  return {mix(a.zenith, b.zenith), mix(a.horizon, b.horizon), mix(a.ground, b.ground), mix(a.glow, b.glow)};
}

/// sine: of the sun's altitude. It is day from 17 degrees on, and night from 12 degrees below the horizon on.
Colors colors_at(double sine) {
  constexpr double day_from = 0.3, night_from = 0.208;
  const auto share = [](double of) { return static_cast<float>(std::clamp(of, 0.0, 1.0)); };
  return sine >= 0 ? mixed(dusk, day, share(sine / day_from)) : mixed(dusk, night, share(-sine / night_from));
}

}  // namespace

double sun_share(double sine) {
  constexpr double whole_from = 0.1;
  return std::clamp(sine / whole_from, 0.0, 1.0);
}

SkyLook::SkyLook(const FrameView& view) {
  const glm::dvec3& to_sun = view.state.sky.to_sun;
  const Colors colors = colors_at(to_sun.y);
  zenith = colors.zenith;
  horizon = colors.horizon;
  ground = colors.ground;
  glow = colors.glow;
  sun = glm::vec3(to_sun);
  const Camera& camera = view.view().camera;
  const glm::dmat3 to_model = glm::transpose(view.rotation);
  if (camera.orthographic()) {
    corner = glm::vec3(to_model * glm::dvec3(0, 0, -1));
    right = up = glm::vec3(0);
    return;
  }
  const double width = (camera.right - camera.left) / view.view().width,
               height = (camera.top - camera.bottom) / view.view().height;
  corner = glm::vec3(to_model * glm::dvec3(camera.left + width / 2, camera.bottom + height / 2, -1));
  right = glm::vec3(to_model * glm::dvec3(width, 0, 0));
  up = glm::vec3(to_model * glm::dvec3(0, height, 0));
}

std::array<uint8_t, 4> SkyLook::at(int32_t x, int32_t y) const {
  const auto along = static_cast<float>(x), upward = static_cast<float>(y);
  const glm::vec3 ray(corner.x + (along * right.x + upward * up.x),
                      corner.y + (along * right.y + upward * up.y),
                      corner.z + (along * right.z + upward * up.z));
  const float scale = 1.0f / std::sqrt((ray.x * ray.x + ray.y * ray.y) + ray.z * ray.z);
  const float sine = ray.y * scale;
  glm::vec3 color = ground;
  if (sine >= 0) {
    const float near_horizon = (1 - sine) * (1 - sine), share = 1 - near_horizon * near_horizon;
    const float towards = ((ray.x * sun.x + ray.y * sun.y) + ray.z * sun.z) * scale;
    float glowing = std::max(0.0f, towards);
    for (int i = 0; i < 5; ++i) glowing *= glowing;
    color = (horizon + (zenith - horizon) * share) + glow * glowing;
    if (towards >= disc_cosine) color = disc;
  }
  const auto byte = [](float channel) {
    return static_cast<uint8_t>(std::rint(std::clamp(channel, 0.0f, 1.0f) * 255.0f));
  };
  return {byte(color.x), byte(color.y), byte(color.z), 255};
}

}  // namespace triptych
