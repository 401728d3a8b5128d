// The rules that selection, bounds, culling and drawing keep, so that tests can take one away at a time.
#pragma once

namespace triptych {

/// Something breaks without any one of these: hard cases prove that taking one away is noticed
/// (docs/hard-cases.md). Outside tests and `--inject` all of them hold.
struct FrameRules {
  // Selection of levels
  bool bounds_hold_children = true;  ///< the error of an HLOD is at least those of its children
  bool orthographic_error = true;    ///< orthographic pixel errors do not divide by depth
  bool min_depth_error = true;      ///< pixel errors divide by a box's least depth, not by the distance to it
  bool oblique_stretch = true;      ///< pixel errors allow for the stretching of oblique views
  bool frustum_margin = true;       ///< planes of the frustum have a margin for what rounding may draw
  bool levels_from_outside = true;  ///< where what is covered may be seen no level leaves it out
  bool model_units = true;          ///< the unit of eye space on the device is near the model's size
  bool current_camera = true;       ///< culling is done under the frame's own camera, not the one before
  bool current_time = true;         ///< and at the frame's own time
  // Bounds on the screen
  bool near_plane_refines = true;  ///< a box that the near plane cuts may be anywhere on the screen
  bool bounds_margin = true;       ///< boxes under test are dilated and moved towards the eye
  bool double_bounds = true;       ///< boxes are projected from double-precision coordinates
  // Culling
  bool map_to_cut = true;              ///< the representation is drawn from drawables of the frame's own cut
  bool hidden_is_gone = true;          ///< what was visible and is hidden now is not drawn into it
  bool retest_hidden = true;           ///< what was hidden one frame ago is tested like everything else
  bool show_all_found = true;          ///< every drawable that is found visible is shown
  bool cut_occludes_nothing = true;    ///< what a section cuts away is not drawn into the representation
  bool glass_occludes_nothing = true;  ///< what is transparent is not drawn into the representation
  bool near_plane_opens_walls = true;  ///< walls that the near plane cuts away close nothing
  // The device
  bool non_strict_test = true;      ///< a box at exactly the representation's depth shows
  bool fragment_bound = true;       ///< fragments nearer than their piece's box are moved back to it
  bool layers_lie_close = true;     ///< layers of a plane are no further apart than rounding asks for
  bool double_positions = true;     ///< geometry is placed from double-precision coordinates
  bool leave_out_backs = true;      ///< backs of outward triangles (Chunk::outward) are not drawn
  bool backs_need_distance = true;  ///< they are where the near plane reaches what they belong to
  bool operator==(const FrameRules&) const = default;
};

}  // namespace triptych
