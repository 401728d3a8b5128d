#include "base/shortest_names.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// The last `count` parts of a path, or all of it.
std::filesystem::path tail(const std::filesystem::path& path, size_t count) {
  const std::vector<std::filesystem::path> parts(path.begin(), path.end());
  std::filesystem::path end;
  for (size_t i = parts.size() - std::min(count, parts.size()); i < parts.size(); ++i) end /= parts[i];
  return end;
}

/// The folder without links or dots, so that different files have different names; the file as it was given.
std::filesystem::path whole_name(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path folder =
      std::filesystem::weakly_canonical(std::filesystem::absolute(file, error).parent_path(), error);
  return folder / file.filename();
}

}  // namespace

std::vector<std::string> shortest_names(std::span<const std::filesystem::path> files) {
  std::vector<std::filesystem::path> names;
  for (const std::filesystem::path& file : files) names.push_back(whole_name(file));
  std::vector<std::string> shortest;
  for (const std::filesystem::path& name : names) {
    const auto shared = [&](size_t count) {
      return std::count_if(names.begin(), names.end(), [&](const std::filesystem::path& other) {
               return tail(other, count) == tail(name, count);
             }) > 1;
    };
    size_t count = 1;
    while (shared(count) && tail(name, count) != name) ++count;
    shortest.push_back(tail(name, count).string());
  }
  return shortest;
}

}  // namespace triptych
