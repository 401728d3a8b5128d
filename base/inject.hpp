// Faults put in on purpose (`--inject NAME`), which prove that the checks can fail.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace triptych {

enum class Fault {
  withheld_id,             ///< culling withholds every fourth drawable that it finds visible
  wrong_delta,             ///< a delta is changed after the digest was taken
  no_digest,               ///< receivers do not compare digests
  strict_depth_test,       ///< boxes are tested with a strict comparison
  no_dilation,             ///< boxes are tested without their margin
  wrong_ancestor,          ///< the visible set is mapped to drawables that are not in the cut
  stale_camera,            ///< culling uses the previous frame's camera
  stale_motion,            ///< culling uses the previous frame's time
  flipped_byte,            ///< one bit of a message is flipped in transit
  carried_hidden,          ///< what was hidden one frame ago stays hidden
  no_near_rule,            ///< boxes cut by the near plane are tested by the corners before it
  no_fragment_bound,       ///< fragments may be nearer than their drawable's box
  float_bounds,            ///< boxes are projected from single-precision coordinates
  float_positions,         ///< geometry is placed by single-precision coordinates
  fixed_units,             ///< eye space on the graphics card is in model units, whatever they are
  euclidean_depth,         ///< the pixel error divides by the distance to a box instead of its least depth
  dropped_stretch,         ///< the pixel error ignores the stretching of oblique views
  perspective_rule,        ///< levels are selected for orthographic views as if they were perspective
  dropped_singular_value,  ///< bounds of placed geometry are not scaled with it
  uncounted_lattice,       ///< rounding to the lattice does not count as an error
  shrinking_bounds,   ///< an HLOD's error leaves out its children's, in builds and in the selection of levels
  unflipped_mirror,   ///< mirrored placements keep their winding
  shared_shears,      ///< meshes are shared under transforms that floats cannot place exactly
  loose_contacts,     ///< levels of detail do not hold the points where surfaces touch
  no_room,            ///< what covers others, and what is covered, may be off by any error
  untold_layers,      ///< of surfaces in one plane nothing says which lies on which
  wide_layers,        ///< surfaces in one plane are moved apart by what snapping may do to them
  unmarked_levels,    ///< nothing says which levels leave out what others cover
  exact_frustum,      ///< the cut leaves out what is behind the frustum's planes by less than rounding
  cut_occludes,       ///< what a section cuts away still hides what is behind it
  backs_nearby,       ///< backs are left out even where the eye is among them
  hidden_occludes,    ///< what a person hides is drawn into the occlusion representation once more
  hollow_levels,      ///< levels that leave out what others cover are drawn where it may be seen
  opaque_glass,       ///< what is transparent hides what lies behind it
  walls_before_near,  ///< walls that the near plane cuts away close what lies behind them
  slow_render_node,   ///< the render node is slow with each packet and frame: no picture may change
  slow_switch_node,   ///< the same for switch node 1
};

/// Turns a fault on for this process. Returns false for an unknown name ("withheld-id" names
/// withheld_id).
bool inject(std::string_view name);
bool injected(Fault fault);
/// Every name that inject() takes, in the order of Fault.
const std::vector<std::string>& fault_names();
/// The names that were injected, for child processes.
std::vector<std::string> injected_names();
/// Forgets every injected fault; for tests.
void clear_injected();

}  // namespace triptych
