// Between which pixels an edge is drawn: where a surface ends before another one, and where it is folded.
#pragma once

#include "lod/frame_view.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace triptych {

/// Faces that meet at this angle or a larger one make a crease: the cosine of 40°.
inline constexpr float crease_cosine = 0.76604444f;
/// A surface ends before another one where neither's plane, continued to the other's pixel, is as near to
/// what is there as so many pixels are wide at that depth.
inline constexpr float step_pixels = 2;
/// What the pixels of edges show; red, green, blue, alpha.
inline constexpr std::array<uint8_t, 4> edge_bytes = {34, 40, 49, 255};

/// What shows at a pixel, or at one sample of it.
struct SurfacePoint {
  float depth = 0;      ///< reversed; 0 where nothing is
  glm::vec3 normal{0};  ///< of its face: eye space, unit length, either side
};

/// Which of two pixels side by side is drawn as an edge.
enum class EdgeOwner : uint8_t { none, first, second };

/// The rule of one frame, in floats, the same operations on every device. Edges change colours, nothing else.
/// It has no memory and takes only what stands in the buffers of a picture, so that a picture with edges is
/// a function of what its own pixels hold. Depth is affine over the screen on a plane, in both projections:
/// of a plane seen ever so obliquely nothing is an edge.
class EdgeRule {
 public:
  explicit EdgeRule(const FrameView& view);

  /// first, second: at these places in the picture, pixels from its lower left corner; second is the one to
  /// the right, or above. Of a step the nearer one is the edge, of a crease the first.
  EdgeOwner between(const SurfacePoint& first, const glm::vec2& at_first, const SurfacePoint& second,
                    const glm::vec2& at_second) const {
    if (first.depth == 0 || second.depth == 0) {
      return first.depth > 0 ? EdgeOwner::first : second.depth > 0 ? EdgeOwner::second : EdgeOwner::none;
    }
    const glm::vec3 from = ray(at_first), to = ray(at_second);
    if (leaves(first, from, second, to) && leaves(second, to, first, from))
      return first.depth >= second.depth ? EdgeOwner::first : EdgeOwner::second;
    const bool crease = std::abs(dot(first.normal, second.normal)) < crease_cosine;
    return crease ? EdgeOwner::first : EdgeOwner::none;
  }

  /// Scale and shift from a place in the picture to x and y at unit depth; orthographic: in model units.
  const glm::vec4& rays() const { return rays_; }
  /// What `step_pixels` are: perspective as a share of the depth, orthographic in depth.
  float tolerance() const { return tolerance_; }
  /// Orthographic: depth of one model unit. Perspective: 0.
  float depth_scale() const { return depth_scale_; }

 private:
  static float dot(const glm::vec3& a, const glm::vec3& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
  glm::vec3 ray(const glm::vec2& at) const {
    return {rays_.x * at.x + rays_.z, rays_.y * at.y + rays_.w, -1.0f};
  }
  /// Whether the plane of p, continued to where q is, leaves what is there. Written so that a plane seen from
  /// its edge does.
  bool leaves(const SurfacePoint& p, const glm::vec3& at_p, const SurfacePoint& q,
              const glm::vec3& at_q) const {
    if (depth_scale_ > 0) {
      const float across = p.normal.x * (at_q.x - at_p.x) + p.normal.y * (at_q.y - at_p.y);
      return !(std::abs((q.depth - p.depth) * p.normal.z + depth_scale_ * across) <=
               tolerance_ * std::abs(p.normal.z));
    }
    const float here = dot(p.normal, at_p), there = dot(p.normal, at_q);
    return !(std::abs(q.depth * here - p.depth * there) <= tolerance_ * (q.depth * std::abs(here)));
  }

  glm::vec4 rays_;
  float tolerance_, depth_scale_;
};

}  // namespace triptych
