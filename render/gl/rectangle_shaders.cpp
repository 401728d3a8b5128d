#include "render/gl/shaders.hpp"

namespace triptych {

namespace {

const std::string version = shader_version;

// Rectangles under test.
const std::string rectangles_block = R"(
struct Rectangle { float sides[4]; float planes[12]; float cuts[12]; };
layout(std430, binding = 2) readonly buffer Rectangles { Rectangle rectangles[]; };
)";

// Where parts of a rectangle overlap, a pixel counts in the one whose plane is the least there: all parts
// compute the same.
const std::string counted_once = rectangles_block + R"(
uniform vec2 overlap;  // an eighth of a pixel
flat in uint slot, own;
bool counts() {
  vec3 at = vec3(gl_FragCoord.xy * (8.0 * overlap) - 1.0, 1.0);
  uint least = 0u;
  float depth = 0.0;
  for (uint i = 0u; i < 4u; ++i) {
    float other = dot(vec3(rectangles[slot].planes[i * 3], rectangles[slot].planes[i * 3 + 1],
                           rectangles[slot].planes[i * 3 + 2]), at);
    if (i == 0u || other < depth) {
      least = i;
      depth = other;
    }
  }
  return own == least;
}
)";

}  // namespace

std::string rectangle_vertex_shader() {
  return version + "#extension GL_ARB_shader_draw_parameters : require\n" + rectangles_block + R"(
uniform vec2 overlap;
flat out uint slot, own;
out float gl_ClipDistance[8];
void main() {
  // Four times the same rectangle, each at one of its planes and cut to where that one is the least, and at its
  // corners.
  uint instance = uint(gl_BaseInstanceARB + gl_InstanceID);
  slot = instance / 4u;
  own = instance % 4u;
  Rectangle r = rectangles[slot];
  float x = r.sides[(gl_VertexID & 1) == 0 ? 0 : 2], y = r.sides[(gl_VertexID & 2) == 0 ? 1 : 3];
  vec3 plane = vec3(r.planes[own * 3], r.planes[own * 3 + 1], r.planes[own * 3 + 2]);
  gl_Position = vec4(x, y, dot(plane, vec3(x, y, 1.0)), 1.0);
  gl_ClipDistance[own] = gl_Position.z;  // the box does not reach where it is negative
  for (uint i = 0u; i < 4u; ++i) {
    gl_ClipDistance[4u + i] = dot(vec3(r.cuts[i * 3], r.cuts[i * 3 + 1], r.cuts[i * 3 + 2]), vec3(x, y, 1.0));
    if (i == own) continue;
    vec3 other = vec3(r.planes[i * 3], r.planes[i * 3 + 1], r.planes[i * 3 + 2]);
    // Pieces overlap, so that snapping leaves no gap between them.
    vec2 slope = abs(other.xy - plane.xy);
    float rounding = 1e-6 * (dot(abs(other), vec3(1.0)) + dot(abs(plane), vec3(1.0)));
    gl_ClipDistance[i] = dot(other, vec3(x, y, 1.0)) - gl_Position.z + dot(slope, overlap) + rounding;
  }
}
)";
}

std::string query_fragment_shader(bool counting) {
  return counting ? version + counted_once + "void main() { if (!counts()) discard; }\n"
                  : version + "void main() {}\n";
}

std::string storage_fragment_shader(bool counting) {
  return counting ? version + counted_once + R"(
layout(early_fragment_tests) in;
layout(std430, binding = 3) buffer Answers { uint answers[]; };
void main() { if (counts()) atomicAdd(answers[slot], 1u); }
)"
                  : version + R"(
layout(early_fragment_tests) in;
flat in uint slot;
layout(std430, binding = 3) writeonly buffer Answers { uint answers[]; };
void main() { answers[slot] = 1u; }
)";
}

}  // namespace triptych
