// Which pixel error to take, of those that were measured.
#pragma once

#include <nlohmann/json.hpp>

namespace triptych {

/// What is asked of a setting that is advised.
inline constexpr double most_swaps_a_million = 20, least_cover_kept = 0.9;
/// An approximate strategy is advised where it is so many times faster than the exact ones.
inline constexpr double approximate_gain = 1.1;

/// rows and violated: as accuracy_json() gives them. [{pack, strategy, min_pixels, pixel_error, faster,
/// says}], one a pack: the coarsest error at which, on every device and at every size, there are no holes,
/// fewer swaps away from edges than most_swaps_a_million, no promise broken and, where it was measured,
/// least_cover_kept; of several strategies the fastest. `faster`: than the finest error of the same strategy.
/// All but pack and says are null where no error is good enough.
nlohmann::json accuracy_advice(const nlohmann::json& rows, const nlohmann::json& violated);

}  // namespace triptych
