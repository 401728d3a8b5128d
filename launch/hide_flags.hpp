// --hide and --isolate: what is not there.
#pragma once

#include "session/run_options.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

namespace triptych {

void add_hide_flags(CLI::App& command, RunOptions& options);
/// {"hidden_objects"}, into a report.
void add_hidden(nlohmann::json& report, const HiddenName& hidden);

}  // namespace triptych
