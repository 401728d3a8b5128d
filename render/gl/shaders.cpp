#include "render/gl/shaders.hpp"

#include "render/draw_list.hpp"
#include "render/gl/shading_source.hpp"
#include "visibility/cap_look.hpp"
#include "visibility/layer_offset.hpp"
#include "visibility/pixel_sides.hpp"

#include <fmt/core.h>
#include <optional>

namespace triptych {

namespace {

const std::string version = shader_version;

// What is the same for all vertices of a draw command comes as attributes that advance with the instance:
// software OpenGL reads them faster than storage buffers.
const std::string draw_record = R"(
layout(location = 2) in vec4 row_x;  // chunk lattice, relative to the eye's cell, to eye space
layout(location = 3) in vec4 row_y;
layout(location = 4) in vec4 row_z;
layout(location = 5) in ivec3 cell;  // the eye's cell, negated
layout(location = 6) in uint drawable;
layout(location = 7) in uint first_bound;
layout(location = 8) in uint cut_of_record;
// No fragment of a piece is nearer than any of three planes over pixel coordinates, nor than at.w.
struct BoundRecord { vec4 x, y, at; };
layout(std430, binding = 4) readonly buffer Bounds { BoundRecord bounds[]; };
)";

// A sliver seen edge-on has depth interpolated beyond its own vertices. Holding every fragment to the bound
// of its piece's box, in every pass, is what makes the rectangle test exact. NaN becomes the bound. Fragments
// only move away from the eye, which lets graphics cards reject hidden ones early.
const std::string bounded = R"(
flat in vec3 bound_x, bound_y;
flat in vec4 bound_at;
float bound_depth(float z) {
  vec3 planes = bound_x * gl_FragCoord.x + bound_y * gl_FragCoord.y + bound_at.xyz;
  float limit = min(min(planes.x, planes.y), min(planes.z, bound_at.w));
  return z <= limit ? z : limit;
}
)";

// Fragments of what others lie on are moved behind those (LayerOffset). Snapping a vertex before depths are
// computed moves what a pixel shows within its plane, but not out of it: so the plane of a layered triangle
// is known here, and with it the depth that it has at the pixel's own place. Before anything is discarded,
// since derivatives need the whole quad.
const std::string layered =
    fmt::format("const float depth_rounding = {};\n", LayerOffset::depth_rounding) + R"(
out float gl_FragDepth;
flat in uint layer;       // 0: nothing else lies in the plane; 1: the uppermost
uniform vec4 layer_view;  // focal lengths, axis
uniform vec4 layer_step;  // LayerOffset::step, snapped, parallel, and the unit of eye space
uniform float snapping;   // LayerOffset::snapping
float change_in_plane(float z) {  // from z to the depth that the plane has here
  vec3 normal = cross(dFdx(eye_position), dFdy(eye_position));
  vec2 here = (gl_FragCoord.xy - layer_view.zw) / (layer_view.xy * layer_step.w);
  if (layer_step.z > 0.0)
    return dot(normal.xy, here - eye_position.xy) / -normal.z * (layer_step.z * layer_step.w);
  return z * (dot(normal.xy, here * -eye_position.z - eye_position.xy) / dot(normal, eye_position));
}
float place_fragment() {
  float drawn = gl_FragCoord.z;
  vec2 slope = vec2(dFdx(drawn), dFdy(drawn));
  float ahead = layer_step.z > 0.0 ? layer_step.z : drawn + dot(slope, layer_view.zw - gl_FragCoord.xy);
  vec2 along = slope * layer_view.xy;
  float normal = sqrt(dot(along, along) + ahead * ahead);
  float change = change_in_plane(drawn);
  float z = bound_depth(layer > 0u && abs(change) <= snapping * normal ? drawn + change : drawn);
  uint layers = max(layer, 1u) - 1u;
  float moved = float(layers) * layer_step.x * normal;
  float sheared = float(layers) * layer_step.y * normal;
  float rounded = float(layers) * depth_rounding;
  float below = layer_step.z > 0.0 ? z * (1.0 - rounded) - (moved + sheared)
                                   : z * max(1.0 - (moved + rounded), 0.5) - sheared;
  return layers > 0u ? max(below, z * 0.5) : z;
}
)";
const std::string not_layered = R"(
layout(depth_less) out float gl_FragDepth;
float place_fragment() { return bound_depth(gl_FragCoord.z); }
)";

// Fragments that a section does not keep are dropped (PixelSides). In the name of backs of closed surfaces
// the cut surface is drawn of that side at which the ray came in last.
const std::string cut_away =
    fmt::format("const uint closed = {}u, mirrored = {}u;\n", DrawRecord::closed, DrawRecord::mirrored) +
    R"(
flat in uint cut;
uniform vec4 sides[12];
uniform vec3 side_normals[12];
uniform int side_count;
float along(vec4 side) { return side.x * gl_FragCoord.x + side.y * gl_FragCoord.y + side.z; }
void cut_fragment() {
  for (uint rest = cut & 0xfffu; rest != 0u; rest &= rest - 1u) {
    vec4 side = sides[findLSB(rest)];
    if (!(along(side) + side.w * gl_FragCoord.z >= 0.0)) discard;
  }
}
int capped_side() {
  if ((cut & closed) == 0u || gl_FrontFacing == ((cut & mirrored) == 0u)) return -1;
  int last = -1;
  float depth = 0.0;
  for (int i = 0; i < side_count; ++i) {
    float r = along(sides[i]);
    if (!(r + sides[i].w < 0.0)) continue;
    float entry = r / -sides[i].w;
    if (last < 0 || entry < depth) {
      last = i;
      depth = entry;
    }
  }
  return last;
}
)" +
    fmt::format(
        "const int hatching_period = {};\nconst float cap_tone = {}, dark_material = {};\n"
        "const vec2 dark_ink = vec2({}, {}), bright_ink = vec2({}, {});\n"
        "const vec3 luminance = vec3({}, {}, {});\n",
        CapHatching::period, cap_tone, dark_material, dark_ink.scale, dark_ink.add, bright_ink.scale,
        bright_ink.add, luminance_of_red, luminance_of_green, luminance_of_blue) +
    R"(
uniform int stroke_width;
vec3 cap_color(vec3 base, float light, int side) {  // CapHatching
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int pitch = hatching_period * stroke_width;
  int along = side % 2 == 0 ? pixel.x + pixel.y : pixel.x - pixel.y + (pitch << 16);
  vec3 lit = base * (cap_tone * light);
  if (along % pitch >= stroke_width) return lit;
  vec2 ink = dot(base, luminance) < dark_material ? bright_ink : dark_ink;
  return lit * ink.x + ink.y;
}
)";
const std::string without_caps = R"(
const vec3 side_normals[1] = vec3[1](vec3(0.0));
int capped_side() { return -1; }
vec3 cap_color(vec3 base, float light, int side) { return base * light; }
)";
const std::string not_cut = "void cut_fragment() {}\n" + without_caps;

// Of a model that is drawn as a whole: what the section does not keep, without cut surfaces.
const std::string cut_whole = without_caps + R"(
uniform vec4 sides[12];
uniform int side_count;
void cut_fragment() {
  for (int i = 0; i < side_count; ++i) {
    vec4 side = sides[i];
    if (!((side.x * gl_FragCoord.x + side.y * gl_FragCoord.y + side.z) + side.w * gl_FragCoord.z >= 0.0)) discard;
  }
}
)";

// Of the sides that may cut a drawable, those at which its ray comes in: whether there are any, and all keep
// it.
const std::string nearest_backs = fmt::format(
    "layout(r32ui, binding = {}) coherent uniform uimage2D nearest_backs;\n", nearest_backs_image);
const std::string counted = nearest_backs + R"(
uniform bool forget;
void main() {
  bool entered = false;
  for (uint rest = cut & 0xfffu; rest != 0u; rest &= rest - 1u) {
    vec4 side = sides[findLSB(rest)];
    float r = along(side);
    if (!(r + side.w < 0.0)) continue;
    if (!(r + side.w * gl_FragCoord.z >= 0.0)) discard;
    entered = true;
  }
  if (!entered) discard;
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (forget) imageStore(nearest_backs, pixel, uvec4(0u));
  else if (gl_FrontFacing == ((cut & mirrored) != 0u))
    imageAtomicMax(nearest_backs, pixel, floatBitsToUint(gl_FragCoord.z));
}
)";

// The cut surface before the nearest back: as deep as the ray comes in, and held to the bound of the back's
// piece.
const std::string capped = nearest_backs + R"(
flat in vec3 bound_x, bound_y;
flat in vec4 bound_at;
void keep_fragment() {
  int side = capped_side();
  if (side < 0 || imageLoad(nearest_backs, ivec2(gl_FragCoord.xy)).r != floatBitsToUint(gl_FragCoord.z)) discard;
  float entry = along(sides[side]) / -sides[side].w;
  // The ray may have left what another side keeps before it comes in.
  for (int i = 0; i < side_count; ++i) {
    float r = along(sides[i]);
    if (!(r + sides[i].w < 0.0) && !(r + sides[i].w * entry >= 0.0)) discard;
  }
  vec3 planes = bound_x * gl_FragCoord.x + bound_y * gl_FragCoord.y + bound_at.xyz;
  float limit = min(min(planes.x, planes.y), min(planes.z, bound_at.w));
  gl_FragDepth = min(entry, limit);
}
)";

const std::string in_eye_space = "in vec3 eye_position;\n";

/// What all passes do with a fragment.
std::string kept(const ShaderVariant& variant) {
  if (variant.caps) return in_eye_space + cut_away + capped + material_shader_source({});
  return in_eye_space + bounded + (variant.layers ? layered : not_layered) +
         (variant.sections ? cut_away : not_cut) + material_shader_source(variant) + R"(
void keep_fragment() {
  look_up();
  gl_FragDepth = place_fragment();
  cut_fragment();
  if (is_hole()) discard;
}
)";
}

// From eye space to clip space; what ViewUniforms sets goes in.
const std::string frustum_uniforms = R"(
uniform vec4 frustum;  // x scale, y scale, x shift, y shift
uniform vec2 depth;    // perspective: the near plane; orthographic: scale and shift
)";
std::string project(Projection projection) {
  return projection == Projection::perspective ? R"(
  gl_Position = vec4(frustum.x * eye_position.x + frustum.z * eye_position.z,
                     frustum.y * eye_position.y + frustum.w * eye_position.z, depth.x, -eye_position.z);
)"
                                               : R"(
  gl_Position = vec4(frustum.x * eye_position.x + frustum.z, frustum.y * eye_position.y + frustum.w,
                     depth.x * eye_position.z + depth.y, 1.0);
)";
}

}  // namespace

std::string geometry_vertex_shader(Projection projection, const ShaderVariant& variant) {
  const bool palette = variant.colors == BaseColors::palette;
  const std::string colors = "layout(std430, binding = 1) readonly buffer Palette { vec4 palette[]; };\n";
  return version + draw_record + frustum_uniforms + flatness(variant.colors) + "out vec4 base_color;\n" +
         (palette || variant.transparent ? colors : "") +
         (palette ? "" : "layout(location = 9) in vec4 vertex_color;\n") +
         (variant.smooth ? eye_normal_source() : std::string()) +
         (variant.transparent ? "flat out float alpha;\nflat out uint record;\n" : "") +
         (variant.textured || variant.emissive ? "flat out uint surface_index;\n" : "") +
         (variant.textured ? "layout(location = 11) in ivec2 coordinates;\nout vec2 texture_place;\n" : "") +
         (variant.baked || variant.occluded ? vertex_light_source() : std::string()) +
         R"(
layout(location = 0) in ivec3 point;
layout(location = 1) in uint color_and_piece;
invariant gl_Position;
uniform vec2 sample_place;  // from pixel centres, pixels: where this pass looks at them
)" + (variant.layers ? "invariant " : "") +
         R"(out vec3 eye_position;
flat out vec3 bound_x, bound_y;
flat out vec4 bound_at;
flat out uint item;
)" + (variant.layers ? "flat out uint layer;\n" : "") +
         (variant.sections ? "flat out uint cut;\n" : "") +
         R"(
void main() {
  // Integers are added exactly and converted once: shared vertices come out bit-equal whichever chunk brings them.
  vec3 p = vec3(point + cell);
  eye_position = vec3(dot(row_x.xyz, p) + row_x.w, dot(row_y.xyz, p) + row_y.w, dot(row_z.xyz, p) + row_z.w);
)" + project(projection) +
         (palette ? "  base_color = palette[color_and_piece & 0xfffffu];\n"
                  : "  base_color = vertex_color;\n") +
         (variant.smooth ? "  shading_normal = eye_normal();\n" : "") +
         R"(
  BoundRecord bound = bounds[first_bound + (color_and_piece >> 24)];
  bound_x = bound.x.xyz;
  bound_y = bound.y.xyz;
  bound_at = bound.at + vec4(bound.x.xyz * sample_place.x + bound.y.xyz * sample_place.y, 0.0);
  item = drawable;
)" +
         (variant.transparent ? "  alpha = palette[color_and_piece & 0xfffffu].a;\n  record = first_bound;\n"
                              : "") +
         (variant.textured || variant.emissive ? "  surface_index = color_and_piece & 0xfffffu;\n" : "") +
         (variant.textured ? "  texture_place = vec2(coordinates) / 65536.0;\n" : "") +
         (variant.baked || variant.occluded ? "  baked_light = light_of_vertex();\n" : "") +
         (variant.layers ? "  layer = color_and_piece >> 20 & 15u;\n" : "") +
         (variant.sections ? "  cut = cut_of_record;\n}\n" : "}\n");
}

std::string depth_fragment_shader(const ShaderVariant& variant) {
  return version + kept(variant) + "void main() { keep_fragment(); }\n";
}

std::string winding_fragment_shader() { return version + cut_away + counted; }

std::string color_fragment_shader(const ShaderVariant& variant) {
  return version + kept(variant) + shaded(variant, variant.normals ? std::optional(1) : std::nullopt) +
         R"(
void main() {
  keep_fragment();
  shade_fragment();
}
)";
}

std::string color_and_item_fragment_shader(const ShaderVariant& variant) {
  return version + kept(variant) + shaded(variant, variant.normals ? std::optional(2) : std::nullopt) +
         R"(
flat in uint item;
layout(location = 1) out uint id;
void main() {
  keep_fragment();
  shade_fragment();
  id = item + 1u;
}
)";
}

std::string item_fragment_shader(const ShaderVariant& variant) {
  return version + kept(variant) + R"(
flat in uint item;
out uint id;
void main() {
  keep_fragment();
  id = item + 1u;
}
)";
}

std::string fragment_list_source() {
  return "struct Fragment { uint next, depth, color, item, record, triangle; };\n" +
         fmt::format("layout(r32ui, binding = {}) coherent uniform uimage2D heads;\n", heads_image) +
         fmt::format("layout(std430, binding = {}) coherent buffer Fragments {{\n", fragments_binding) +
         R"(  uint count, capacity, unused_1, unused_2;
  Fragment fragments[];
};
)";
}

std::string transparent_fragment_shader(const ShaderVariant& variant) {
  return version + kept(variant) + shaded(variant) + fragment_list_source() +
         fmt::format("layout(binding = {}) uniform sampler2DArray opaque_depths;\n", opaque_depths_unit) + R"(
uniform int plane;
flat in float alpha;
flat in uint item, record;
void main() {
  keep_fragment();
  float z = gl_FragDepth;
  shade_fragment();
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (!(z > 0.0) || z < texelFetch(opaque_depths, ivec3(pixel, plane), 0).r) discard;
  uint index = atomicAdd(count, 1u);
  if (index >= capacity) return;
  uint next = imageAtomicExchange(heads, pixel, index + 1u);
  fragments[index] = Fragment(next, floatBitsToUint(z), packUnorm4x8(vec4(color.rgb, covered(alpha))), item, record,
                              uint(gl_PrimitiveID));
}
)";
}

std::string flat_model_vertex_shader(Projection projection) {
  return version + frustum_uniforms + R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 vertex_color;
uniform mat3 to_eye;
uniform vec3 shift;
out vec3 eye_position;
flat out vec4 base_color;
void main() {
  eye_position = to_eye * position + shift;
)" + project(projection) +
         R"(  base_color = vertex_color;
}
)";
}

std::string flat_model_fragment_shader(bool sections) {
  return version + in_eye_space + (sections ? cut_whole : not_cut) + material_shader_source({}) + shaded({}) +
         "void main() { cut_fragment(); shade_fragment(); }\n";
}

}  // namespace triptych
