#include "render/shaders.hpp"

namespace triptych {

namespace {

const std::string version = "#version 450\n";

const std::string draw_record = R"(
struct DrawRecord {
  vec4 rows[3];         // chunk lattice, relative to the eye's cell, to eye space
  ivec3 cell;           // the eye's cell, negated
  float nearest_depth;  // no fragment of the drawable is nearer
  uint item;
  uint unused0, unused1, unused2;
};
layout(std430, binding = 0) readonly buffer Draws { DrawRecord draws[]; };
)";

// A sliver seen edge-on has depth interpolated beyond its own vertices. Bounding every fragment by its
// drawable's nearest corner, in every pass, is what makes the rectangle test exact. Written so that NaN is
// dropped too.
const std::string bounded = R"(
flat in float nearest_depth;
void bound_fragment() { if (!(gl_FragCoord.z <= nearest_depth)) discard; }
)";

// The shaded colour of a fragment, the same text for every pass that draws colours.
const std::string shaded = R"(
in vec3 eye_position;
flat in vec4 base_color;
uniform vec3 light;  // direction to the light, eye space
layout(location = 0) out vec4 color;
void shade_fragment() {
  vec3 normal = cross(dFdx(eye_position), dFdy(eye_position));
  float length_squared = dot(normal, normal);
  normal *= length_squared > 0.0 ? inversesqrt(length_squared) : 0.0;
  // Both sides are lit: CAD models do not agree on which side is out.
  color = vec4(base_color.rgb * (0.42 + 0.38 * abs(dot(normal, light)) + 0.20 * abs(normal.z)), 1.0);
}
)";

}  // namespace

std::string geometry_vertex_shader(Projection projection) {
  return version + "#extension GL_ARB_shader_draw_parameters : require\n" + draw_record + R"(
layout(std430, binding = 1) readonly buffer Palette { vec4 palette[]; };
layout(location = 0) in ivec3 point;
layout(location = 1) in uint color_index;
uniform vec4 frustum;  // x scale, y scale, x shift, y shift
uniform vec2 depth;    // perspective: the near plane; orthographic: scale and shift
invariant gl_Position;
out vec3 eye_position;
flat out vec4 base_color;
flat out float nearest_depth;
flat out uint item;
void main() {
  DrawRecord draw = draws[gl_BaseInstanceARB];
  // Integers are added exactly and converted once: shared vertices come out bit-equal whichever chunk brings them.
  vec3 p = vec3(point + draw.cell);
  eye_position = vec3(dot(draw.rows[0].xyz, p) + draw.rows[0].w, dot(draw.rows[1].xyz, p) + draw.rows[1].w,
                      dot(draw.rows[2].xyz, p) + draw.rows[2].w);
)" +
         (projection == Projection::perspective ? R"(
  gl_Position = vec4(frustum.x * eye_position.x + frustum.z * eye_position.z,
                     frustum.y * eye_position.y + frustum.w * eye_position.z, depth.x, -eye_position.z);
)"
                                                : R"(
  gl_Position = vec4(frustum.x * eye_position.x + frustum.z, frustum.y * eye_position.y + frustum.w,
                     depth.x * eye_position.z + depth.y, 1.0);
)") +
         R"(  base_color = palette[color_index];
  nearest_depth = draw.nearest_depth;
  item = draw.item;
}
)";
}

std::string depth_fragment_shader() { return version + bounded + "void main() { bound_fragment(); }\n"; }

std::string color_fragment_shader() {
  return version + bounded + shaded + R"(
void main() {
  bound_fragment();
  shade_fragment();
}
)";
}

std::string color_and_item_fragment_shader() {
  return version + bounded + shaded + R"(
flat in uint item;
layout(location = 1) out uint id;
void main() {
  bound_fragment();
  shade_fragment();
  id = item + 1u;
}
)";
}

std::string item_fragment_shader() {
  return version + bounded + R"(
flat in uint item;
out uint id;
void main() {
  bound_fragment();
  id = item + 1u;
}
)";
}

std::string rectangle_vertex_shader() {
  return version + "#extension GL_ARB_shader_draw_parameters : require\n" + R"(
struct Rectangle { float left, bottom, right, top, depth; };
layout(std430, binding = 2) readonly buffer Rectangles { Rectangle rectangles[]; };
flat out uint slot;
void main() {
  slot = uint(gl_BaseInstanceARB + gl_InstanceID);
  Rectangle r = rectangles[slot];
  gl_Position = vec4((gl_VertexID & 1) == 0 ? r.left : r.right, (gl_VertexID & 2) == 0 ? r.bottom : r.top, r.depth, 1.0);
}
)";
}

std::string query_fragment_shader() { return version + "void main() {}\n"; }

std::string storage_fragment_shader() {
  return version + R"(
layout(early_fragment_tests) in;
flat in uint slot;
layout(std430, binding = 3) writeonly buffer Answers { uint answers[]; };
void main() { answers[slot] = 1u; }
)";
}

}  // namespace triptych
