// Rules that make a build's bounds true. All of them hold, unless a test breaks one to prove that the checks
// notice.
#pragma once

namespace triptych {

struct BuildRules {
  bool bounds_hold_children = true;  ///< the error of an HLOD is at least those of its children
  bool bounds_hold_rounding = true;  ///< rounding to the lattice counts as an error
  bool bounds_are_stretched = true;  ///< bounds of placed geometry grow with the transform's stretch
  bool mirrors_flip_winding = true;  ///< triangles under a mirroring transform get the opposite winding
  bool contacts_hold = true;         ///< Kept::touching is kept
  bool order_is_kept = true;         ///< Kept::order is kept
  bool layers_are_told = true;       ///< Kept::planes is kept
  bool levels_are_marked = true;     ///< those that leave out what others cover are
  /// Meshes are shared only under transforms of at most this condition number, for which floats are precise
  /// enough.
  double max_condition = 8;
};

}  // namespace triptych
