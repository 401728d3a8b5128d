#include "launch/named_files.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace triptych {

namespace {

struct NamedFile {
  std::string flag;
  std::filesystem::path path;
  bool written, folder;
};

std::string type_of(const CLI::Option& option) { return option.get_type_name(); }

void collect(const CLI::App& app, std::vector<NamedFile>& files) {
  for (const CLI::Option* option : app.get_options()) {
    if (!names_files(*option)) continue;
    for (const std::string& name : option->results())
      files.push_back({option->get_name(), name, is_written(*option), type_of(*option) == "DIR"});
  }
  for (const CLI::App* chosen : app.get_subcommands()) collect(*chosen, files);
}

}  // namespace

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(a, error);
  if (error) return false;  // what cannot be looked at is refused by whoever opens it
  return whole == std::filesystem::weakly_canonical(b, error) && !error;
}

void check_is_none_of(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs,
                      const std::string& what_they_are) {
  for (const std::filesystem::path& input : inputs) {
    if (is_same_file(output, input)) fail(output.string(), "is {}, which would be lost", what_they_are);
  }
}

bool is_written(const CLI::Option& option) {
  constexpr std::array<std::string_view, 6> flags = {"--json", "--output", "--timeline",
                                                     "--keep", "--record", "--journal"};
  return std::count(flags.begin(), flags.end(), option.get_name()) > 0;
}

bool names_files(const CLI::Option& option) {
  constexpr std::array<std::string_view, 5> types = {"FILE", "INPUT", "HOSTS", "DIR", "PATH"};
  const std::string type = type_of(option);
  return std::any_of(types.begin(), types.end(),
                     [&](const std::string_view known) { return type.starts_with(known); });
}

void check_files_differ(const CLI::App& app) {
  std::vector<NamedFile> files;
  collect(app, files);
  for (const NamedFile& file : files) {
    if (!file.written) continue;
    for (const NamedFile& other : files) {
      if (&file == &other || (file.folder && other.folder) || !is_same_file(file.path, other.path)) continue;
      fail(file.path.string(), "{} would be written over {}, which the same command line names as {}",
           file.flag, other.path.string(), other.flag);
    }
  }
}

}  // namespace triptych
