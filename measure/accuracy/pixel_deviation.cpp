#include "measure/accuracy/pixel_deviation.hpp"

#include "base/threads.hpp"
#include "preprocess/check/check_distances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace triptych {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Calls measure(pixel) → PointDeviation for those whose surface is known; side by side.
template <typename Measure>
std::vector<PointDeviation> measured(std::span<const SurfacePixel> shown, std::span<const size_t> pixels,
                                     const Measure& measure) {
  std::vector<size_t> known;
  for (const size_t pixel : pixels) {
    if (shown[pixel].found) known.push_back(pixel);
  }
  std::vector<PointDeviation> deviations(known.size());
  constexpr size_t batch = 256;
  parallel_for((known.size() + batch - 1) / batch, [&](size_t part) {
    for (size_t i = part * batch; i < std::min(known.size(), (part + 1) * batch); ++i)
      deviations[i] = measure(shown[known[i]]);
  });
  return deviations;
}

PointDeviation deviation(const FrameView& view, DrawableId drawable, const glm::dvec3& place,
                         double distance) {
  return {distance > 0 ? projected_distance(view, place, distance) : 0, drawable, place};
}

}  // namespace

std::vector<size_t> spread_pixels(size_t count, size_t of) {
  std::vector<size_t> pixels(std::min(count, of));
  if (pixels.size() == of) {
    std::iota(pixels.begin(), pixels.end(), size_t{0});
    return pixels;
  }
  // Steps of about the golden ratio of the whole, which no pixel repeats.
  auto step = static_cast<size_t>(static_cast<double>(of) * 0.6180339887498949);
  while (std::gcd(step, of) != 1) ++step;
  for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = i * step % of;
  std::sort(pixels.begin(), pixels.end());  // neighbours show the same surfaces
  return pixels;
}

std::vector<PointDeviation> shown_deviations(const PackSurfaces& surfaces, const FrameView& view,
                                             std::span<const SurfacePixel> shown,
                                             std::span<const size_t> pixels) {
  const Skeleton& skeleton = surfaces.skeleton();
  return measured(shown, pixels, [&](const SurfacePixel& pixel) {
    if (is_source(skeleton, pixel.drawable)) return deviation(view, pixel.drawable, pixel.point, 0);
    const SceneNodeId node = skeleton.drawables[pixel.drawable].scene_node;
    return deviation(
        view, pixel.drawable, pixel.point,
        surfaces.nearest_source(node, pixel.point, 0, nullptr, no_id, view.state.hiding.objects.get())
            .distance);
  });
}

std::vector<PointDeviation> reference_deviations(const PackSurfaces& surfaces, const FrameView& view,
                                                 const Cut& cut, std::span<const SurfacePixel> reference,
                                                 std::span<const size_t> pixels) {
  const Skeleton& skeleton = surfaces.skeleton();
  return measured(reference, pixels, [&](const SurfacePixel& pixel) {
    SceneNodeId node = skeleton.drawables[pixel.drawable].scene_node;
    while (node != no_id && cut.choice[node] >= Cut::inner) node = skeleton.scene_nodes[node].parent;
    if (node == no_id) return PointDeviation{infinite, pixel.drawable, pixel.point};
    const DrawableId stands = cut.choice[node];
    const double distance =
        stands == pixel.drawable
            ? 0
            : surfaces.distance_to_drawable(stands, pixel.point, 0, nullptr, view.state.hiding.objects.get());
    return deviation(view, stands, pixel.point, distance);
  });
}

}  // namespace triptych
