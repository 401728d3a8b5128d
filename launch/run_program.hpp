// This program run again, to its end, for the figures that it writes: what a process of its own costs.
#pragma once

#include "launch/build_flags.hpp"

#include <nlohmann/json.hpp>

namespace triptych {

/// Runs `triptych ARGUMENTS… --json FILE` with this process's --threads and returns what it wrote. What it
/// prints comes through on standard error; the file stands in `folder`. Error with the child's complaint
/// where it fails, or where a signal told this process to end.
nlohmann::json run_program(const std::string& name, std::vector<std::string> arguments,
                           const std::filesystem::path& folder);

/// The same for `triptych build`, into the pack. Nothing may be left there of an earlier build.
nlohmann::json run_build(const BuildFlags& flags, const std::filesystem::path& pack);

}  // namespace triptych
