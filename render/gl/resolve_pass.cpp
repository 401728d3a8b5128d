#include "render/gl/resolve_pass.hpp"

#include "scene/sample_places.hpp"
#include "visibility/edge_rule.hpp"
#include "visibility/pixel_sides.hpp"

#include <fmt/core.h>
#include <vector>

namespace triptych {

namespace {

constexpr GLuint colors_unit = 0, depths_unit = 1, normals_unit = 2, veils_unit = 4;

const char* const vertex_source = R"(#version 450
void main() {  // one triangle over the whole picture
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

const char* const no_edges = "bool is_edge(ivec2 pixel, int plane) { return false; }\n";

// EdgeRule::leaves.
std::string leaves(Projection projection) {
  return projection == Projection::perspective ? R"(
bool leaves(float p, vec3 normal, vec3 at_p, float q, vec3 at_q) {
  float here = dot(normal, at_p), there = dot(normal, at_q);
  return !(abs(q * here - p * there) <= tolerance * (q * abs(here)));
}
)"
                                               : R"(
bool leaves(float p, vec3 normal, vec3 at_p, float q, vec3 at_q) {
  float across = dot(normal.xy, at_q.xy - at_p.xy);
  return !(abs((q - p) * normal.z + depth_scale * across) <= tolerance * abs(normal.z));
}
)";
}

// Of what shows; where that is the cut surface at a side of the section, of that.
const char* const surface_source = R"(
layout(binding = 1) uniform sampler2DArray depths;
layout(binding = 2) uniform sampler2DArray normals;
uniform vec4 rays;
uniform vec2 places[16];  // of each plane's samples, pixels
uniform vec4 sides[12];   // PixelSide
float depth_at(ivec3 at) {
  float depth = texelFetch(depths, at, 0).r;
  float side = texelFetch(normals, at, 0).a * 16.0;
  if (depth == 0.0 || side > 12.0) return depth;
  vec4 cap = sides[int(side + 0.5)];
  vec2 place = vec2(at.xy) + places[at.z];
  return (cap.x * place.x + cap.y * place.y + cap.z) / -cap.w;
}
)";

// EdgeRule::between, asked of a pixel about each of its neighbours.
std::string edges(Projection projection) {
  return fmt::format("const float crease_cosine = {};\n", crease_cosine) + R"(
uniform float tolerance, depth_scale;
)" + surface_source +
         leaves(projection) +
         R"(
vec3 ray(ivec2 pixel, int plane) { return vec3((vec2(pixel) + places[plane]) * rays.xy + rays.zw, -1.0); }
vec3 normal_at(ivec3 at) { return texelFetch(normals, at, 0).xyz * 2.0 - 1.0; }
bool owns(ivec2 pixel, ivec2 other, int plane, float here, vec3 normal, bool first) {
  if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, textureSize(depths, 0).xy))) return false;
  float there = depth_at(ivec3(other, plane));
  if (there == 0.0) return true;
  vec3 other_normal = normal_at(ivec3(other, plane)), from = ray(pixel, plane), to = ray(other, plane);
  if (leaves(here, normal, from, there, to) && leaves(there, other_normal, to, here, from))
    return first ? here >= there : here > there;
  return first && abs(dot(normal, other_normal)) < crease_cosine;
}
bool is_edge(ivec2 pixel, int plane) {
  float here = depth_at(ivec3(pixel, plane));
  if (here == 0.0) return false;
  vec3 normal = normal_at(ivec3(pixel, plane));
  return owns(pixel, pixel + ivec2(1, 0), plane, here, normal, true) ||
         owns(pixel, pixel + ivec2(0, 1), plane, here, normal, true) ||
         owns(pixel, pixel - ivec2(1, 0), plane, here, normal, false) ||
         owns(pixel, pixel - ivec2(0, 1), plane, here, normal, false);
}
)";
}

// What is transparent over a color of 0 to 255.
const char* const veil_source = R"(
layout(binding = 4) uniform sampler2DArray veils;
uvec3 veiled(uvec3 behind, ivec3 at) {
  vec4 veil = texelFetch(veils, at, 0);
  return uvec3(min(veil.rgb * 255.0 + veil.a * vec3(behind), vec3(255.0)) + 0.5);
}
)";
const char* const no_veils = "uvec3 veiled(uvec3 behind, ivec3 at) { return behind; }\n";

std::string fragment_source(bool with_edges, bool with_veils, Projection projection) {
  return "#version 450\nlayout(binding = 0) uniform sampler2DArray colors;\n" +
         std::string(with_veils ? veil_source : no_veils) + (with_edges ? edges(projection) : no_edges) +
         fmt::format("const uvec3 edge_color = uvec3({}, {}, {});\n", edge_bytes[0], edge_bytes[1],
                     edge_bytes[2]) +
         R"(
layout(location = 0) out vec4 color;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int planes = textureSize(colors, 0).z;
  uvec3 sum = uvec3(uint(planes) / 2u);
  for (int plane = 0; plane < planes; ++plane) {
    ivec3 at = ivec3(pixel, plane);
    sum += veiled(is_edge(pixel, plane) ? edge_color : uvec3(texelFetch(colors, at, 0).rgb * 255.0 + 0.5), at);
  }
  color = vec4(vec3(sum / uint(planes)) / 255.0, 1.0);
}
)";
}

}  // namespace

void ResolvePass::draw(const FrameView& view, const Framebuffer& planes, const GlTextureArray* veils,
                       const Framebuffer& picture) {
  const bool with_edges = planes.layout().normals;
  const Projection projection = view.view().camera.projection;
  const bool with_veils = veils != nullptr;
  std::optional<GlProgram>& program =
      programs_[with_edges ? 1 : 0][with_veils ? 1 : 0][static_cast<size_t>(projection)];
  if (!program)
    program = make_program("resolve", vertex_source, fragment_source(with_edges, with_veils, projection));
  glUseProgram(*program);
  if (with_edges) {
    const EdgeRule rule(view);
    const glm::vec4& rays = rule.rays();
    glUniform4f(glGetUniformLocation(*program, "rays"), rays.x, rays.y, rays.z, rays.w);
    std::vector<glm::vec2> places;
    for (const SamplePlace& place : sample_places(planes.layout().samples))
      places.emplace_back(0.5 + place.pixels());
    glUniform2fv(glGetUniformLocation(*program, "places"), static_cast<GLsizei>(places.size()), &places[0].x);
    const PixelSides sides(view);
    if (!sides.all().empty())
      glUniform4fv(glGetUniformLocation(*program, "sides"), static_cast<GLsizei>(sides.all().size()),
                   &sides.all()[0].x);
    glUniform1f(glGetUniformLocation(*program, "tolerance"), rule.tolerance());
    glUniform1f(glGetUniformLocation(*program, "depth_scale"), rule.depth_scale());
    glBindTextureUnit(depths_unit, planes.depths());
    glBindTextureUnit(normals_unit, planes.normals());
  }
  if (with_veils) glBindTextureUnit(veils_unit, *veils);
  glBindTextureUnit(colors_unit, planes.colors());
  picture.bind();
  glBindVertexArray(vertex_array_);
  glDisable(GL_DEPTH_TEST);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace triptych
