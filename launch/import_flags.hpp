// The flags of every command that reads model files.
#pragma once

#include "model/import/import.hpp"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace triptych {

/// --up, --unit and --chord.
void add_import_flags(CLI::App& command, ImportOptions& options);
/// The arguments that give the same flags to another process.
std::vector<std::string> import_arguments(const ImportOptions& options);
/// The formats by their extensions, for --help.
std::string format_help();

}  // namespace triptych
