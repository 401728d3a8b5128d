// Flags that cut away what stands before what one wants to see.
#pragma once

#include "scene/section.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

namespace triptych {

/// --section, up to six times, and --section-box. The section must outlive the command.
void add_section_flags(CLI::App& command, Section& section);
/// {"planes": [{"normal": [x, y, z], "offset"}], "box": [x0, y0, z0, x1, y1, z1] or null}.
nlohmann::json section_json(const Section& section);

}  // namespace triptych
