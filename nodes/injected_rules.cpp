#include "nodes/injected_rules.hpp"

#include "base/inject.hpp"

namespace triptych {

FrameRules injected_frame_rules() {
  return {.bounds_hold_children = !injected(Fault::shrinking_bounds),
          .orthographic_error = !injected(Fault::perspective_rule),
          .min_depth_error = !injected(Fault::euclidean_depth),
          .oblique_stretch = !injected(Fault::dropped_stretch),
          .frustum_margin = !injected(Fault::exact_frustum),
          .levels_from_outside = !injected(Fault::hollow_levels),
          .model_units = !injected(Fault::fixed_units),
          .current_camera = !injected(Fault::stale_camera),
          .current_time = !injected(Fault::stale_motion),
          .near_plane_refines = !injected(Fault::no_near_rule),
          .bounds_margin = !injected(Fault::no_dilation),
          .double_bounds = !injected(Fault::float_bounds),
          .map_to_cut = !injected(Fault::wrong_ancestor),
          .hidden_is_gone = !injected(Fault::hidden_occludes),
          .retest_hidden = !injected(Fault::carried_hidden),
          .show_all_found = !injected(Fault::withheld_id),
          .cut_occludes_nothing = !injected(Fault::cut_occludes),
          .glass_occludes_nothing = !injected(Fault::opaque_glass),
          .near_plane_opens_walls = !injected(Fault::walls_before_near),
          .non_strict_test = !injected(Fault::strict_depth_test),
          .fragment_bound = !injected(Fault::no_fragment_bound),
          .layers_lie_close = !injected(Fault::wide_layers),
          .double_positions = !injected(Fault::float_positions),
          .backs_need_distance = !injected(Fault::backs_nearby)};
}

}  // namespace triptych
