// Values of flags that the user's files triptych.toml give, where the command line does not.
#pragma once

#include "launch/usage.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace triptych {

/// Flags for one command, as words of its command line, and where each of them stands: "triptych.toml: line
/// 3: size" by its flag ("--size").
struct Defaults {
  std::vector<std::string> words;
  std::map<std::string, std::string> places;
};

/// The files that are read, the more important first: triptych.toml in the working folder, and in triptych/
/// of XDG_CONFIG_HOME or ~/.config. TRIPTYCH_CONFIG names one file in their stead, or, if it is empty, none.
/// Only those that are there.
std::vector<std::filesystem::path> default_files();

/// What the files say of the command, without what the command line gives itself, or what does not go
/// together with it, or needs another flag that is not given. A file has flags for every command that takes
/// them, and tables for one: [render], [measure.session]. Error (file, line, key) for a file that is no TOML,
/// a flag or command that there is none of, and a value of a kind that no flag has.
Defaults read_defaults(CLI::App& app, const WordsRead& line, const std::vector<std::filesystem::path>& files);

}  // namespace triptych
