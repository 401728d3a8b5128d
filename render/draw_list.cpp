#include "render/draw_list.hpp"

#include "base/inject.hpp"
#include "visibility/drawable_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace triptych {

DrawListBuilder::DrawListBuilder(const Skeleton& skeleton, const View& view)
    : skeleton_(skeleton),
      view_(view),
      clip_(clip_space(skeleton, view)),
      rotation_(view.rotation()),
      projector_(skeleton, view),
      placed_(skeleton.transforms.size()),
      placed_with_lattice_(skeleton.transforms.size(), no_id) {}

const DrawListBuilder::PlacedLattice& DrawListBuilder::place(uint32_t transform, uint32_t lattice_index) {
  PlacedLattice& placed = placed_[transform];
  if (placed_with_lattice_[transform] == lattice_index) return placed;
  placed_with_lattice_[transform] = lattice_index;
  const Affine& affine = skeleton_.transforms[transform];
  const Lattice& lattice = skeleton_.lattices[lattice_index];
  const glm::dmat3 linear(affine);
  // The lattice cell nearest to the eye, as seen from the mesh. A far-away eye is clamped: then distances are
  // large and float precision relative to them is enough.
  glm::dvec3 cell =
      glm::round((glm::inverse(linear) * (clip_.reference - affine[3]) - lattice.origin) / lattice.step);
  for (int axis = 0; axis < 3; ++axis) {
    cell[axis] =
        std::isfinite(cell[axis]) ? glm::clamp<double>(cell[axis], -Lattice::limit, Lattice::limit) : 0;
  }
  glm::dvec3 residual = linear * (lattice.origin + lattice.step * cell) + (affine[3] - clip_.reference);
  if (injected(Fault::float_positions)) {
    residual = glm::vec3(linear * lattice.origin + affine[3]) - glm::vec3(clip_.reference);
    residual += linear * (lattice.step * cell);
  }
  const glm::dmat3 to_eye = rotation_ * linear * (lattice.step / clip_.unit);
  const glm::dvec3 shift = rotation_ * (residual / clip_.unit);
  for (int row = 0; row < 3; ++row) {
    placed.rows[row] = glm::vec4(to_eye[0][row], to_eye[1][row], to_eye[2][row], shift[row]);
  }
  placed.cell = -glm::ivec3(cell);
  return placed;
}

BoundRecord DrawListBuilder::bound(const LatticeBox& box) const {
  DepthBound bound;
  if (!injected(Fault::no_fragment_bound)) bound = projector_.depth_bound(box);
  BoundRecord record{.x = {}, .y = {}, .at = glm::vec4(bound.nearest)};
  for (int i = 0; i < 3; ++i) {
    const DepthPlane& plane = bound.planes[static_cast<size_t>(i)];
    record.x[i] = plane.slope.x * 2.0f / static_cast<float>(view_.width);
    record.y[i] = plane.slope.y * 2.0f / static_cast<float>(view_.height);
    record.at[i] = plane.at(-1, -1);
  }
  return record;
}

void DrawListBuilder::append(const DeviceScene& scene, std::span<const DrawableId> drawables,
                             DrawList& list) {
  for (const DrawableId id : drawables) {
    const Drawable& drawable = skeleton_.drawables[id];
    DrawRecord record{};
    record.item = id;
    const LatticeBox& node_box = skeleton_.scene_nodes[drawable.scene_node].box;
    for (uint32_t i = 0; i < drawable.placement_count; ++i) {
      const Placement& placement = skeleton_.placements[drawable.first_placement + i];
      const DeviceScene::Range& range = scene.range(placement.chunk);
      if (!range.loaded()) continue;
      const PlacedLattice& placed = place(placement.transform, skeleton_.chunks[placement.chunk].lattice);
      list.commands.push_back({.index_count = range.index_count,
                               .instance_count = 1,
                               .first_index = range.first_index,
                               .base_vertex = static_cast<int32_t>(range.base_vertex),
                               .base_instance = static_cast<uint32_t>(list.records.size())});
      record.first_bound = static_cast<uint32_t>(list.bounds.size());
      boxes_.clear();
      append_piece_boxes(skeleton_, placement, node_box, boxes_);
      for (const LatticeBox& box : boxes_) list.bounds.push_back(bound(box));
      std::copy(std::begin(placed.rows), std::end(placed.rows), record.rows);
      record.cell = placed.cell;
      list.records.push_back(record);
    }
    list.triangles += drawable.triangles;
  }
}

}  // namespace triptych
