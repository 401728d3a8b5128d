#include "visibility/depth_bound.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {
/// Planes with larger terms bound nothing: floats are precise enough up to here.
constexpr double max_term = 0x1p20;
/// Orthographic: faces seen more obliquely than this bound nothing.
constexpr double min_cosine = 0x1p-10;

double max_coordinate(const glm::dvec3& a) { return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}); }
}  // namespace

PixelDepthBound pixel_bound(const DepthBound& bound, int width, int height) {
  PixelDepthBound pixels;
  pixels.at = glm::vec4(bound.nearest);
  for (int i = 0; i < 3; ++i) {
    const DepthPlane& plane = bound.planes[static_cast<size_t>(i)];
    pixels.x[i] = plane.slope.x * 2.0f / static_cast<float>(width);
    pixels.y[i] = plane.slope.y * 2.0f / static_cast<float>(height);
    pixels.at[i] = plane.at(-1, -1);
  }
  return pixels;
}

FacePlanes::FacePlanes(const FrameView& view, const DeviceMargins& margins)
    : view_(view.view()),
      clip_(view.clip),
      rotation_(view.rotation),
      snapping_(margins.plane),
      stretch_(view_.corner_stretch()) {
  const Box model = view.skeleton->lattice().box(view.skeleton->scene_nodes[0].box);
  tiny_ = 0x1p-34 *
          std::max({max_coordinate(view_.camera.eye), max_coordinate(model.lo), max_coordinate(model.hi)});
}

std::array<DepthPlane, 3> FacePlanes::of(const Box& box, double slack) const {
  std::array<DepthPlane, 3> planes;
  for (int axis = 0; axis < 3; ++axis) {
    planes[static_cast<size_t>(axis)] =
        clip_.orthographic ? parallel(axis, box, slack) : perspective(axis, box, slack);
  }
  return planes;
}

/// Content is at least `distance` beyond the eye along the axis. A ray that goes `along` it by s for each
/// unit of z gets there at z = distance / s, which is at depth near · s / distance; and s is affine over the
/// screen. All terms, the slack's too, shrink as 1 / distance: boxes within this one have lower planes.
DepthPlane FacePlanes::perspective(int axis, const Box& box, double slack) const {
  const double low = box.lo[axis] - clip_.reference[axis], high = box.hi[axis] - clip_.reference[axis];
  const double distance = std::max(low, -high);
  if (!(distance > tiny_)) return {};
  const double scale = (low > 0 ? 1 : -1) * clip_.near / distance;
  const Camera& camera = view_.camera;
  const glm::dvec3 along = rotation_[axis];  // right, up and backward
  const glm::dvec2 slope =
      scale * 0.5 *
      glm::dvec2(along.x * (camera.right - camera.left), along.y * (camera.top - camera.bottom));
  const double middle = scale * (along.x * 0.5 * (camera.left + camera.right) +
                                 along.y * 0.5 * (camera.bottom + camera.top) - along.z);
  const double nearer = 1 + slack * share_of_depth;
  return with_slack(slope * nearer, middle * nearer, std::abs(scale) * vertex_rounding * stretch_, slack);
}

/// The same where rays are parallel: on the face, how far a ray has come is affine in where it starts.
DepthPlane FacePlanes::parallel(int axis, const Box& box, double slack) const {
  const glm::dvec3 along = rotation_[axis];
  const double forward = -along.z;
  if (std::abs(forward) < min_cosine) return {};
  const double low = box.lo[axis] - clip_.reference[axis], high = box.hi[axis] - clip_.reference[axis];
  const double start = (forward > 0 ? low : high) / forward;
  const Camera& camera = view_.camera;
  const double scale = 1 / (forward * clip_.range);
  const glm::dvec2 slope =
      scale * 0.5 *
      glm::dvec2(along.x * (camera.right - camera.left), along.y * (camera.top - camera.bottom));
  const double middle =
      clip_.depth(clip_.reference_depth + start) +
      scale * 0.5 * (along.x * (camera.left + camera.right) + along.y * (camera.bottom + camera.top));
  const double distance = glm::length(glm::max(glm::abs(box.lo - clip_.reference),  //
                                               glm::abs(box.hi - clip_.reference)));
  return with_slack(slope, middle,
                    (share_of_depth * clip_.range + vertex_rounding * distance) * std::abs(scale), slack);
}

/// Snapping moves what is drawn across the slope.
DepthPlane FacePlanes::with_slack(const glm::dvec2& slope, double middle, double rounding,
                                  double slack) const {
  const double terms = std::abs(slope.x) + std::abs(slope.y) + std::abs(middle);
  if (!(terms + rounding < max_term)) return {};
  const double added =
      rounding + snapping_ * (2 * std::abs(slope.x) / view_.width + 2 * std::abs(slope.y) / view_.height) +
      plane_rounding * terms;
  return {glm::vec2(slope), static_cast<float>(middle + slack * added)};
}

}  // namespace triptych
