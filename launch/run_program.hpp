// Runs this program again as a process of its own, and returns the figures that it writes.
#pragma once

#include "base/signals.hpp"
#include "launch/build_flags.hpp"

#include <functional>
#include <nlohmann/json.hpp>
#include <sys/types.h>

namespace triptych {

/// Runs `triptych ARGUMENTS… --json FILE` with this process's --threads and returns what it wrote. What it
/// prints is passed on to standard error; the file is written in `folder`. Error with the child's message if
/// it fails, or once `stop`, asked a few times a second, is true. The default is true once a signal asks this
/// process to end, and from then on signals do no more than that. started: is told which process it is.
nlohmann::json run_program(const std::string& name, std::vector<std::string> arguments,
                           const std::filesystem::path& folder, bool (*stop)() = stop_requested,
                           const std::function<void(pid_t)>& started = {});

/// The same for `triptych build`, which writes the pack.
nlohmann::json run_build(const BuildFlags& flags, const std::filesystem::path& pack,
                         bool (*stop)() = stop_requested, const std::function<void(pid_t)>& started = {});

}  // namespace triptych
