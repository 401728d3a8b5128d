// The files that a command line names: those that are read must be there, those that are written must be
// possible, and what is written must not take the place of anything else among them.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <vector>

namespace triptych {

/// Whether both names lead to one file, through links too; or would, where no file is there yet.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Error (output) where it is one of these files.
void check_is_none_of(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs,
                      const std::string& what_they_are);

/// Flags whose file or folder is written, in whatever command: they mean the same everywhere.
bool is_written(const CLI::Option& option);
/// Whether the option names a file or a folder; known by how the help text calls its value.
bool names_files(const CLI::Option& option);
/// The names, as shell patterns, that a command gives to what it writes into the folder of this option.
std::vector<std::string> names_written_into(const CLI::Option& folder, const std::string& command);

/// Error (the file) where a file that the parsed command writes is another one that it was given, or would be
/// by what it writes into a folder of that command. Folders may be the same: what is put into them has names
/// of its own.
void check_files_differ(const CLI::App& app);
/// Error (the file) where one that the parsed command reads cannot be read, or one that it writes cannot be
/// written: before there is any work to lose. Nothing is made for finding that out.
void check_files_can_be_used(const CLI::App& app);

}  // namespace triptych
