// Whether two roles can play in one session.
#pragma once

#include "protocol/messages.hpp"

#include <string>

namespace triptych {

/// What keeps the two from one session, naming both: "pack differs: render node has …, switch node 0 has …".
/// Empty if nothing does.
std::string difference_between(const Hello& own, const Hello& peer);

}  // namespace triptych
