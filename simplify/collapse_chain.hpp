// The chain of levels that collapses and clusterings give.
#pragma once

#include "simplify/scattered.hpp"
#include "simplify/simplify.hpp"

namespace triptych {

/// As simplify(), of the whole surface at once. first: what the chain begins with.
Chain collapse_chain(const Surface& surface, std::span<const uint8_t> locked, const SimplifyLimits& limits,
                     const FirstLevel& first = {});

}  // namespace triptych
