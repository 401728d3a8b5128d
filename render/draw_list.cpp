#include "render/draw_list.hpp"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace triptych {

void DrawList::clear() {
  records.clear();
  bounds.clear();
  commands.clear();
  triangles = 0;
}

DrawListBuilder::DrawListBuilder(const Skeleton& skeleton)
    : skeleton_(skeleton), is_placed_(skeleton_.transforms.size()), placed_(skeleton_.transforms.size()) {}

void DrawListBuilder::begin(const FrameView& view) {
  view_ = view;
  projector_.emplace(view);
  is_placed_.clear();
}

const DrawListBuilder::PlacedLattice& DrawListBuilder::place(uint32_t transform, uint32_t lattice_index) {
  PlacedLattice& placed = placed_[transform];
  if (!is_placed_.mark_first(transform) && placed.lattice == lattice_index) return placed;
  placed.lattice = lattice_index;
  const ClipSpace& clip = view_->clip;
  const Affine& affine = skeleton_.transforms[transform];
  const Lattice& lattice = skeleton_.lattices[lattice_index];
  const glm::dmat3 linear(affine);
  // The lattice cell nearest to the eye, as seen from the mesh. A far-away eye is clamped: then distances are
  // large and float precision relative to them is enough.
  glm::dvec3 cell =
      glm::round((glm::inverse(linear) * (clip.reference - affine[3]) - lattice.origin) / lattice.step);
  for (int axis = 0; axis < 3; ++axis) {
    cell[axis] =
        std::isfinite(cell[axis]) ? glm::clamp<double>(cell[axis], -Lattice::limit, Lattice::limit) : 0;
  }
  glm::dvec3 residual = linear * (lattice.origin + lattice.step * cell) + (affine[3] - clip.reference);
  if (!view_->rules.double_positions) {
    residual = glm::vec3(linear * lattice.origin + affine[3]) - glm::vec3(clip.reference);
    residual += linear * (lattice.step * cell);
  }
  const glm::dmat3 to_eye = view_->rotation * linear * (lattice.step / clip.unit);
  const glm::dvec3 shift = view_->rotation * (residual / clip.unit);
  for (int row = 0; row < 3; ++row) {
    placed.rows[row] = glm::vec4(to_eye[0][row], to_eye[1][row], to_eye[2][row], shift[row]);
  }
  placed.cell = -glm::ivec3(cell);
  return placed;
}

BoundRecord DrawListBuilder::bound(const LatticeBox& box) const {
  DepthBound bound;
  if (view_->rules.fragment_bound) bound = projector_->depth_bound(box);
  BoundRecord record{.x = {}, .y = {}, .at = glm::vec4(bound.nearest)};
  for (int i = 0; i < 3; ++i) {
    const DepthPlane& plane = bound.planes[static_cast<size_t>(i)];
    record.x[i] = plane.slope.x * 2.0f / static_cast<float>(view_->view().width);
    record.y[i] = plane.slope.y * 2.0f / static_cast<float>(view_->view().height);
    record.at[i] = plane.at(-1, -1);
  }
  return record;
}

void DrawListBuilder::append(std::span<const ChunkRange> ranges, std::span<const DrawItem> items,
                             DrawList& list) {
  for (const DrawItem& item : items) {
    const ChunkRange& range = ranges[item.chunk];
    if (!range.loaded()) continue;
    const PlacedLattice& placed = place(item.transform, skeleton_.chunks[item.chunk].lattice);
    list.commands.push_back({.index_count = item.index_count,
                             .instance_count = 1,
                             .first_index = range.first_index + item.first_index,
                             .base_vertex = static_cast<int32_t>(range.base_vertex),
                             .base_instance = static_cast<uint32_t>(list.records.size())});
    DrawRecord record{};
    record.item = item.drawable;
    record.first_bound = static_cast<uint32_t>(list.bounds.size());
    record.cell = placed.cell;
    std::copy(std::begin(placed.rows), std::end(placed.rows), record.rows);
    list.records.push_back(record);
    for (const LatticeBox& box : item.pieces) list.bounds.push_back(bound(box));
    list.triangles += item.index_count / 3;
  }
}

}  // namespace triptych
