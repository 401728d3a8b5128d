// Which key does what.
#pragma once

#include "view/window.hpp"

#include <optional>

namespace triptych {

/// What pressing a key once does: GLFW's numbers of keys and bits of modifiers. Nullopt: nothing.
std::optional<Command> command_of(int key, int modifiers);
/// The same where the control key makes it another.
std::optional<Command> control_command_of(int key, int modifiers);

}  // namespace triptych
