#include "render/gl/sky_pass.hpp"

#include "visibility/sky_look.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

const char* const vertex_source = R"(#version 450
void main() {  // one triangle over the whole picture
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

// SkyLook::at.
std::string fragment_source() {
  return fmt::format("#version 450\nconst float disc_cosine = {};\nconst vec3 disc = vec3({}, {}, {});\n",
                     SkyLook::disc_cosine, SkyLook::disc.x, SkyLook::disc.y, SkyLook::disc.z) +
         R"(
uniform vec3 zenith, horizon, ground, glow, sun, corner, right, up;
layout(location = 0) out vec4 color;
void main() {
  vec2 pixel = floor(gl_FragCoord.xy);
  vec3 ray = normalize(corner + (pixel.x * right + pixel.y * up));
  vec3 shown = ground;
  if (ray.y >= 0.0) {
    float near_horizon = (1.0 - ray.y) * (1.0 - ray.y), share = 1.0 - near_horizon * near_horizon;
    float towards = dot(ray, sun), glowing = max(0.0, towards);
    for (int i = 0; i < 5; ++i) glowing *= glowing;
    shown = horizon + (zenith - horizon) * share + glow * glowing;
    if (towards >= disc_cosine) shown = disc;
  }
  color = vec4(clamp(shown, 0.0, 1.0), 1.0);
}
)";
}

}  // namespace

EffectUse SkyPass::draw(const FrameView& view, const Framebuffer& planes) {
  if (!program_) program_ = make_program("sky", vertex_source, fragment_source());
  const SkyLook look(view);
  glUseProgram(*program_);
  const auto set = [&](const char* name, const glm::vec3& value) {
    glUniform3f(glGetUniformLocation(*program_, name), value.x, value.y, value.z);
  };
  set("zenith", look.zenith);
  set("horizon", look.horizon);
  set("ground", look.ground);
  set("glow", look.glow);
  set("sun", look.sun);
  set("corner", look.corner);
  set("right", look.right);
  set("up", look.up);
  glBindVertexArray(vertex_array_);
  glDisable(GL_DEPTH_TEST);
  // Ids and normals stay as they were cleared.
  constexpr GLuint most_outputs = 3;
  for (GLuint output = 1; output < most_outputs; ++output)
    glColorMaski(output, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  const uint32_t count = planes.layout().samples;
  for (uint32_t plane = 0; plane < count; ++plane) {
    planes.bind(plane);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glEnable(GL_DEPTH_TEST);
  return {.effect = Effect::sky,
          .draws = count,
          .binds = 1,
          .fragments = uint64_t{count} * static_cast<uint64_t>(planes.width()) *
                       static_cast<uint64_t>(planes.height()),
          .variants = 1};
}

}  // namespace triptych
