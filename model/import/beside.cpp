#include "model/import/beside.hpp"

#include <algorithm>
#include <cctype>

namespace triptych {

std::vector<std::string> spellings_of(std::string_view name) {
  std::vector<std::string> spellings = {std::string(name)};
  const auto add = [&](std::string spelling) {
    if (!spelling.empty() && std::find(spellings.begin(), spellings.end(), spelling) == spellings.end())
      spellings.push_back(std::move(spelling));
  };
  if (name.size() > 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  std::string portable(name);
  add(portable);
  std::replace(portable.begin(), portable.end(), '\\', '/');
  add(portable);
  if (const size_t slash = portable.rfind('/'); slash != std::string::npos) add(portable.substr(slash + 1));
  return spellings;
}

bool equal_but_for_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

std::optional<std::filesystem::path> find_beside(const std::filesystem::path& folder, std::string_view name) {
  if (name.find('\0') != std::string_view::npos) return std::nullopt;
  std::error_code error;
  const std::vector<std::string> spellings = spellings_of(name);
  for (const std::string& spelling : spellings) {
    if (std::filesystem::is_regular_file(folder / spelling, error)) return folder / spelling;
  }
  std::optional<std::filesystem::path> found;
  for (const std::string& spelling : spellings) {
    const std::filesystem::path wanted = folder / spelling;
    const auto parent = wanted.has_parent_path() ? wanted.parent_path() : std::filesystem::path(".");
    const std::string last = wanted.filename().string();
    for (std::filesystem::directory_iterator entry(parent, error), end; !error && entry != end;
         entry.increment(error)) {
      if (equal_but_for_case(entry->path().filename().string(), last) && entry->is_regular_file(error) &&
          (!found || entry->path() < *found))
        found = entry->path();
    }
    if (found) return found;
  }
  return std::nullopt;
}

}  // namespace triptych
