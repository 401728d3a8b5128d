#include "render/gl/shading_source.hpp"

#include "scene/vertex_light.hpp"
#include "scene/vertex_normal.hpp"
#include "visibility/shading.hpp"

#include <fmt/core.h>

namespace triptych {

std::string flatness(BaseColors colors) { return colors == BaseColors::palette ? "flat " : ""; }

std::string shaded(const ShaderVariant& variant, std::optional<int> normal_location) {
  const std::string declared =
      normal_location ? fmt::format("layout(location = {}) out vec4 face_normal;\n", *normal_location) : "";
  const std::string written =
      normal_location ? "  face_normal = vec4(normal * 0.5 + 0.5, side < 0 ? 1.0 : float(side) / 16.0);\n"
                      : "";
  return fmt::format("const float ambient = {}, diffuse = {}, head = {};\n{}in vec4 base_color;\n",
                     ambient_light, diffuse_light, head_light, flatness(variant.colors)) +
         declared + (variant.smooth ? "in vec3 shading_normal;\n" : "") +
         (variant.baked || variant.occluded ? "in vec4 baked_light;\n" : "") + R"(
uniform vec3 light;  // direction to the light, eye space
layout(location = 0) out vec4 color;
void shade_fragment() {
  vec3 normal = cross(dFdx(eye_position), dFdy(eye_position));
  float length_squared = dot(normal, normal);
  normal *= length_squared > 0.0 ? inversesqrt(length_squared) : 0.0;
  int side = capped_side();
  if (side >= 0) normal = side_normals[side];
)" + written +
         (variant.smooth
              ? "  if (side < 0 && shading_normal != vec3(0.0)) normal = normalize(shading_normal);\n"
              : "") +
         (variant.occluded
              ? R"(
  float lit = diffuse * abs(dot(normal, light)) + (ambient + head * abs(normal.z)) * baked_light.a;
)"
              : R"(  float lit = ambient + diffuse * abs(dot(normal, light)) + head * abs(normal.z);
)") +
         (variant.baked ? "  vec3 shown = shown_of(min(linear_of(base_shown(base_color.rgb)) * "
                          "baked_light.rgb, vec3(1.0)));\n"
                        : "  vec3 shown = base_shown(base_color.rgb) * lit;\n") +
         R"(  color = vec4(side < 0 ? with_glow(shown) : cap_color(base_color.rgb, lit, side), 1.0);
}
)";
}

std::string vertex_light_source() {
  return fmt::format("const float most_irradiance = {}.0;\n", most_irradiance) + R"(
layout(location = 12) in vec4 vertex_light;
out vec4 baked_light;
vec4 light_of_vertex() {
  return vec4(most_irradiance * (vertex_light.rgb * vertex_light.rgb), (vertex_light.a * 255.0 - 1.0) / 254.0);
}
)";
}

std::string eye_normal_source() {
  return fmt::format("const float middle = {}.0, reach = {}.0;\n", normal_middle, normal_reach) +
         R"(
layout(location = 10) in uvec2 vertex_normal;
out vec3 shading_normal;
vec3 eye_normal() {
  if (vertex_normal.x == 0u) return vec3(0.0);
  vec2 folded = (vec2(vertex_normal) - middle) / reach;
  vec3 own = vec3(folded, 1.0 - abs(folded.x) - abs(folded.y));
  if (own.z < 0.0) {
    own.xy = 1.0 - abs(folded.yx);
    if (folded.x < 0.0) own.x = -own.x;
    if (folded.y < 0.0) own.y = -own.y;
  }
  vec3 most = max(max(abs(row_x.xyz), abs(row_y.xyz)), abs(row_z.xyz));
  float scale = max(max(most.x, most.y), most.z);  // so that products neither overflow nor vanish
  vec3 x = row_x.xyz / scale, y = row_y.xyz / scale, z = row_z.xyz / scale;
  return normalize(vec3(dot(cross(y, z), own), dot(cross(z, x), own), dot(cross(x, y), own)));
}
)";
}

}  // namespace triptych
