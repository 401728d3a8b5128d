#include "launch/sample_folder.hpp"

#include "base/error.hpp"
#include "base/file_access.hpp"
#include "base/partial_files.hpp"

#include <algorithm>
#include <array>
#include <fnmatch.h>
#include <string_view>

namespace triptych {

namespace {

/// What samples write into their scenes as the program that made them.
constexpr std::string_view maker = "triptych sample ";

/// Whether the text is in the file.
bool contains(const std::filesystem::path& file, std::string_view text) {
  const Descriptor opened = open_to_read(file);
  std::string before;  // the end of the last stretch: the text may lie across
  bool found = false;
  read_in_stretches(opened.number(), size_of(opened.number(), file.string()), file.string(),
                    [&](std::span<const std::byte> bytes) {
                      if (found) return;
                      before.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
                      found = before.find(text) != std::string::npos;
                      before.erase(0, before.size() - std::min(before.size(), text.size()));
                    });
  return found;
}

}  // namespace

void check_holds_only_samples(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  constexpr std::array scenes = {"scene.gltf", "scene.ply", "kit.gltf"};
  std::error_code error;
  for (const char* scene : scenes) {
    if (std::filesystem::is_regular_file(folder / scene, error) && contains(folder / scene, maker)) return;
  }
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name_of_partial(name).empty()) continue;  // nobody's: a process that is gone left it half written
    const auto is_name = [&](const std::string& pattern) {
      return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
    };
    if (std::any_of(names.begin(), names.end(), is_name))
      fail(entry->path().string(),
           "would be overwritten, and was not made by `triptych sample`: take another folder, or --force");
  }
}

}  // namespace triptych
