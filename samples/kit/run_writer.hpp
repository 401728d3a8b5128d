// Runs a program that writes one file of a sample.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace triptych {

/// Waits for its end. Error (what) for a program that is not there or fails, with what it said behind
/// "triptych: " on its standard error; and, the program killed, once `stop`, which may be null, returns true.
void run_writer(const std::string& what, const std::filesystem::path& program,
                std::vector<std::string> arguments, bool (*stop)());
/// The same for a script that Node runs.
void run_script(const std::string& what, const std::filesystem::path& script,
                std::vector<std::string> arguments, bool (*stop)());

}  // namespace triptych
