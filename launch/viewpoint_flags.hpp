// The flags of a window that begins at a viewpoint.
#pragma once

#include "session/first_viewpoint.hpp"

#include <CLI/CLI.hpp>

namespace triptych {

/// --bcf and --viewpoint. The command must have --path already.
void add_viewpoint_flags(CLI::App& command, FirstViewpoint& viewpoint);

}  // namespace triptych
