// The files that a command line names: those that are read must exist, those that are written must be
// writable, and no output may replace another file of the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <vector>

namespace triptych {

/// Whether both names are of one file, also through links; or would be, if the file does not exist yet.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Error (output) if it is one of these files.
void check_is_none_of(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs,
                      const std::string& what_they_are);

/// Whether this value of the option is no file, but standard output: --json -.
bool is_standard_output(const CLI::Option& option, const std::string& name);
/// Whether the flag's file or folder is written; the same in every command.
bool is_written(const CLI::Option& option);
/// Whether the option names a file or a folder; by the type of its value in the help text.
bool names_files(const CLI::Option& option);
/// The names, as shell patterns, that a command gives to what it writes into the folder of this option.
std::vector<std::string> names_written_into(const CLI::Option& folder, const std::string& command);

/// Error (the file) if a file that the parsed command writes is also another file of its command line, or a
/// file that it writes into one of its folders. Folders may be the same: the files written into them have
/// different names.
void check_files_differ(const CLI::App& app);
/// Error (the file) if one that the parsed command reads cannot be read, or one that it writes cannot be
/// written: before there is any work to lose. Leaves nothing behind.
void check_files_can_be_used(const CLI::App& app);

}  // namespace triptych
