// Runs this program again as a process of its own, and returns the figures that it writes.
#pragma once

#include "launch/build_flags.hpp"

#include <nlohmann/json.hpp>

namespace triptych {

/// Runs `triptych ARGUMENTS… --json FILE` with this process's --threads and returns what it wrote. What it
/// prints is passed on to standard error; the file is written in `folder`. Error with the child's message if
/// it fails, or if a signal asks this process to end.
nlohmann::json run_program(const std::string& name, std::vector<std::string> arguments,
                           const std::filesystem::path& folder);

/// The same for `triptych build`, which writes the pack. No unfinished build of that pack may be left.
nlohmann::json run_build(const BuildFlags& flags, const std::filesystem::path& pack);

}  // namespace triptych
