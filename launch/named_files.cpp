#include "launch/named_files.hpp"

#include "base/error.hpp"
#include "base/file_access.hpp"
#include "protocol/http_source.hpp"

#include <algorithm>
#include <array>
#include <fnmatch.h>
#include <string_view>

namespace triptych {

namespace {

struct NamedFile {
  std::string flag;
  std::filesystem::path path;
  bool written, folder;
  std::vector<std::string> puts;  ///< names of files that are written into the folder
};

std::string type_of(const CLI::Option& option) { return option.get_type_name(); }

/// An output may be a picture or a folder of pictures: then --frames decides.
bool is_folder(const CLI::App& app, const CLI::Option& option) {
  const CLI::Option* frames = app.get_option_no_throw("--frames");
  return type_of(option) == "DIR" || (type_of(option) == "PATH" && frames && frames->count() > 0);
}

void collect(const CLI::App& app, std::vector<NamedFile>& files) {
  for (const CLI::Option* option : app.get_options()) {
    if (!names_files(*option)) continue;
    const bool written = is_written(*option), folder = is_folder(app, *option);
    for (const std::string& name : option->results()) {
      if (is_standard_output(*option, name) || (!written && is_web_address(name))) continue;
      files.push_back({option->get_name(), name, written, folder, {}});
      if (written && folder) files.back().puts = names_written_into(*option, app.get_name());
    }
  }
  for (const CLI::App* chosen : app.get_subcommands()) collect(*chosen, files);
}

std::vector<NamedFile> files_of(const CLI::App& app) {
  std::vector<NamedFile> files;
  collect(app, files);
  return files;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

/// Whether the file has the name of a file that is written into the folder, directly or through links.
bool is_put_into(const NamedFile& folder, const std::filesystem::path& file) {
  std::error_code error;
  for (const auto& name : {file, std::filesystem::weakly_canonical(file, error)}) {
    if (!is_same_file(folder_of(name), folder.path)) continue;
    for (const std::string& pattern : folder.puts) {
      if (::fnmatch(pattern.c_str(), name.filename().c_str(), 0) == 0) return true;
    }
  }
  return false;
}

/// Whether the path is, or would be, below the folder.
bool is_below(const std::filesystem::path& path, const std::filesystem::path& folder) {
  std::error_code error;
  for (auto above = std::filesystem::weakly_canonical(path, error); above.has_relative_path();) {
    above = above.parent_path();
    if (is_same_file(above, folder)) return true;
  }
  return false;
}

void check_apart(const NamedFile& file, const NamedFile& other) {
  if (!(file.folder && other.folder) && is_same_file(file.path, other.path)) {
    fail(file.path.string(), "{} would be written over {}, which the same command line names as {}",
         file.flag, other.path.string(), other.flag);
  }
  if (!other.folder && is_put_into(file, other.path)) {
    fail(other.path.string(), "is a name that this command gives to what it writes into its {} {}", file.flag,
         file.path.string());
  }
  if (!file.folder && other.written && is_below(other.path, file.path))
    fail(file.path.string(), "{} cannot be a file and the folder for {}", file.flag, other.path.string());
}

}  // namespace

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(a, error);
  if (error) return false;  // a file that cannot be examined is refused when it is opened
  return whole == std::filesystem::weakly_canonical(b, error) && !error;
}

void check_is_none_of(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs,
                      const std::string& what_they_are) {
  for (const std::filesystem::path& input : inputs) {
    if (is_same_file(output, input)) fail(output.string(), "is {}, which would be lost", what_they_are);
  }
}

bool is_standard_output(const CLI::Option& option, const std::string& name) {
  return option.get_name() == "--json" && name == "-";
}

bool is_written(const CLI::Option& option) {
  constexpr std::array<std::string_view, 8> flags = {"--json",   "--output",  "--timeline", "--keep-pack",
                                                     "--record", "--journal", "--cache",    "--place-file"};
  return std::count(flags.begin(), flags.end(), option.get_name()) > 0;
}

bool names_files(const CLI::Option& option) {
  constexpr std::array<std::string_view, 5> types = {"FILE", "INPUT", "HOSTS", "DIR", "PATH"};
  const std::string type = type_of(option);
  return std::any_of(types.begin(), types.end(),
                     [&](const std::string_view known) { return type.starts_with(known); });
}

std::vector<std::string> names_written_into(const CLI::Option& folder, const std::string& command) {
  if (folder.get_name() == "--record") return {"*.recording"};
  if (command == "report") return {"report.html", "report.json", "report-pictures"};
  constexpr std::array<std::string_view, 5> samples = {"building", "plant", "services", "isosurface",
                                                       "statue"};
  if (std::count(samples.begin(), samples.end(), command) > 0) {
    std::vector<std::string> names = {"scene.*",   "walk.json",  "fly.json",       "spin.json",
                                      "jump.json", "orbit.json", "ATTRIBUTION.txt"};
    if (command == "building") names.emplace_back("textures");
    return names;
  }
  if (command == "kit") return {"kit.*", "walk.json"};
  if (command == "effects") return {"*.gltf", "*.bin", "walk.json", "fly.json", "spin.json", "jump.json"};
  return {"[0-9]*.png"};
}

void check_files_differ(const CLI::App& app) {
  const std::vector<NamedFile> files = files_of(app);
  for (const NamedFile& file : files) {
    for (const NamedFile& other : files) {
      if (file.written && &file != &other) check_apart(file, other);
    }
  }
}

void check_files_can_be_used(const CLI::App& app) {
  const std::vector<NamedFile> files = files_of(app);
  for (const NamedFile& file : files) {
    if (file.path.empty()) fail(file.flag, "is given an empty name");
    if (!file.written) file.folder ? check_folder_there(file.path) : check_readable(file.path);
  }
  // A file may be written into a folder that the same command makes.
  const auto will_be_made = [&](const std::filesystem::path& folder) {
    return !std::filesystem::exists(folder) &&
           std::any_of(files.begin(), files.end(), [&](const NamedFile& made) {
             return made.written && made.folder &&
                    (is_same_file(folder, made.path) || is_below(made.path, folder));
           });
  };
  for (const NamedFile& file : files) {
    if (!file.written) continue;
    if (file.folder) {
      check_folder_writable(file.path);
    } else if (!will_be_made(folder_of(file.path))) {
      check_writable(file.path);
    }
  }
}

}  // namespace triptych
