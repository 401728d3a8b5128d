#include "visibility/vertex_terms.hpp"

#include "base/rounding.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace triptych {

LatticePlacer::LatticePlacer(const Skeleton& skeleton)
    : skeleton_(skeleton), is_known_(skeleton.transforms.size()), known_(skeleton.transforms.size()) {}

void LatticePlacer::begin(const FrameView& view) {
  view_ = view;
  is_known_.clear();
}

PlacedLattice LatticePlacer::place(uint32_t transform, uint32_t lattice) {
  Known& known = known_[transform];
  if (is_known_.mark_first(transform) || known.lattice != lattice) {
    const NearestRounding rounding;
    known = {lattice, compute(transform, lattice)};
  }
  return known.placed;
}

[[gnu::noinline]] PlacedLattice LatticePlacer::compute(uint32_t transform, uint32_t lattice_index) const {
  PlacedLattice placed;
  const ClipSpace& clip = view_->clip;
  const Affine affine = view_->transform(transform);
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

ClipTerms clip_terms(const FrameView& view, const SamplePlace& place) {
  const Camera& camera = view.view().camera;
  const ClipSpace& clip = view.clip;
  const double width = camera.right - camera.left, height = camera.top - camera.bottom;
  // The frustum of one sample of each pixel is a little lopsided.
  const glm::dvec2 offset = 2.0 * place.pixels() / glm::dvec2(view.view().width, view.view().height);
  const double shift_x = (camera.right + camera.left) / width + offset.x,
               shift_y = (camera.top + camera.bottom) / height + offset.y;
  const double scale = clip.orthographic ? 2 * clip.unit : 2;  // sides are tangents, or model units
  const double side = clip.orthographic ? -1 : 1;              // shifts go with −z, or with 1
  ClipTerms terms{.frustum = glm::vec4(scale / width, scale / height, side * shift_x, side * shift_y),
                  .depth = glm::vec2(clip.near / clip.unit, 0)};
  if (clip.orthographic) terms.depth = glm::vec2(clip.unit / clip.range, clip.depth(clip.reference_depth));
  return terms;
}

}  // namespace triptych
