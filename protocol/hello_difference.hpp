// Whether two roles can take part in one session.
#pragma once

#include "protocol/messages.hpp"

#include <string>

namespace triptych {

/// Why the two cannot be in one session, naming both: "pack differs: render node has …, switch node 0 has …".
/// Empty if they can.
std::string difference_between(const Hello& own, const Hello& peer);

}  // namespace triptych
