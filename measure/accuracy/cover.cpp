#include "measure/accuracy/cover.hpp"

#include "base/threads.hpp"
#include "visibility/frame_target.hpp"
#include "visibility/screen_bounds.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// The i-th point of the van der Corput sequence of this base, 0 up to 1.
double halton(size_t i, size_t base) {
  double fraction = 1, value = 0;
  for (++i; i > 0; i /= base) {
    fraction /= static_cast<double>(base);
    value += fraction * static_cast<double>(i % base);
  }
  return value;
}

/// Scene nodes at or above leaves.
std::vector<uint8_t> above(const Skeleton& skeleton, std::span<const SceneNodeId> leaves) {
  std::vector<uint8_t> marked(skeleton.scene_nodes.size(), 0);
  for (SceneNodeId node : leaves) {
    for (; node != no_id && marked[node] == 0; node = skeleton.scene_nodes[node].parent) marked[node] = 1;
  }
  return marked;
}

}  // namespace

std::vector<glm::dvec2> pixel_shifts(size_t count) {
  std::vector<glm::dvec2> shifts;
  for (size_t i = 0; i < count; ++i) shifts.emplace_back(halton(i, 2) - 0.5, halton(i, 3) - 0.5);
  return shifts;
}

FrameState shifted(FrameState state, const glm::dvec2& shift) {
  Camera& camera = state.view.camera;
  const double across = shift.x / state.view.focal_x(), up = shift.y / state.view.focal_y();
  camera.left += across;
  camera.right += across;
  camera.bottom += up;
  camera.top += up;
  return state;
}

std::vector<SceneNodeId> small_leaves(const Skeleton& skeleton, const FrameView& view,
                                      std::span<const uint32_t> reference_items) {
  const BoxProjector projector(view);
  const double wide = 2 * small_object_pixels / view.view().width,
               high = 2 * small_object_pixels / view.view().height;
  std::vector<SceneNodeId> leaves;
  for (const DrawableId id : owners({reference_items.begin(), reference_items.end()})) {
    const SceneNodeId node = skeleton.drawables[id].scene_node;
    const ScreenBounds bounds = projector.bounds(projector.box(node));
    const ScreenRectangle& rectangle = bounds.rectangle;
    if (bounds.kind == ScreenBounds::Kind::rectangle && rectangle.right - rectangle.left <= wide &&
        rectangle.top - rectangle.bottom <= high)
      leaves.push_back(node);
  }
  std::sort(leaves.begin(), leaves.end());
  return leaves;
}

void count_cover(const Skeleton& skeleton, std::span<const uint32_t> reference_items,
                 std::span<const SceneNodeId> leaves, CoverCounts& counts) {
  for (const uint32_t item : reference_items) {
    if (item == 0) continue;
    const SceneNodeId leaf = skeleton.drawables[item - 1].scene_node;
    if (std::binary_search(leaves.begin(), leaves.end(), leaf)) ++counts[leaf];
  }
}

void count_cover(const PackSurfaces& surfaces, const FrameView& view, std::span<const uint32_t> items,
                 std::span<const SceneNodeId> leaves, CoverCounts& counts) {
  const Skeleton& skeleton = surfaces.skeleton();
  const std::vector<uint8_t> leads_there = above(skeleton, leaves);
  std::vector<uint32_t> asked(items.begin(), items.end());
  for (uint32_t& item : asked) {
    if (item != 0 && leads_there[skeleton.drawables[item - 1].scene_node] == 0) item = 0;
  }
  const std::vector<SurfacePixel> pixels = surface_pixels(surfaces, view, asked);
  std::vector<SceneNodeId> covered(pixels.size(), no_id);
  const auto width = static_cast<size_t>(view.view().width);
  parallel_for(static_cast<size_t>(view.view().height), [&](size_t row) {
    for (size_t at = row * width; at < (row + 1) * width; ++at) {
      if (!pixels[at].found) continue;
      const SceneNodeId node = skeleton.drawables[pixels[at].drawable].scene_node;
      const bool leaf = skeleton.scene_nodes[node].child_count == 0;
      covered[at] = leaf ? node : surfaces.nearest_source(node, pixels[at].point, 0).leaf;
    }
  });
  for (const SceneNodeId leaf : covered) {
    if (leaf != no_id && std::binary_search(leaves.begin(), leaves.end(), leaf)) ++counts[leaf];
  }
}

CoverChange compare_cover(const CoverCounts& reference, const CoverCounts& shown) {
  CoverChange cover;
  for (const auto& [leaf, pixels] : reference) {
    const auto found = shown.find(leaf);
    const double had = static_cast<double>(pixels),
                 has = found == shown.end() ? 0 : static_cast<double>(found->second);
    cover.reference += had;
    cover.kept += std::min(had, has);
    cover.grown += std::max(has - had, 0.0);
  }
  return cover;
}

}  // namespace triptych
