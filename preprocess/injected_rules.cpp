#include "preprocess/injected_rules.hpp"

#include "base/inject.hpp"

#include <limits>

namespace triptych {

BuildRules injected_build_rules() {
  return {.bounds_hold_children = !injected(Fault::shrinking_bounds),
          .bounds_hold_rounding = !injected(Fault::uncounted_lattice),
          .bounds_are_stretched = !injected(Fault::dropped_singular_value),
          .mirrors_flip_winding = !injected(Fault::unflipped_mirror),
          .contacts_hold = !injected(Fault::loose_contacts),
          .order_is_kept = !injected(Fault::no_room),
          .layers_are_told = !injected(Fault::untold_layers),
          .levels_are_marked = !injected(Fault::unmarked_levels),
          .max_condition = injected(Fault::shared_shears) ? std::numeric_limits<double>::infinity()
                                                          : BuildRules().max_condition};
}

}  // namespace triptych
