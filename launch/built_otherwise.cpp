#include "launch/built_otherwise.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

std::optional<std::string> value_of(const PackOptions& options, const std::string& name) {
  const auto found = options.find(name);
  return found == options.end() ? std::nullopt : std::optional(found->second);
}

nlohmann::json json_of(const std::optional<std::string>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

/// Whether it decides which triangles the finest level has, and what objects there are.
bool changes_the_model(const std::string& option) {
  return option == "chord" || option == "flat" || option == "bake-light" || option == "ambient";
}

}  // namespace

std::vector<BuiltOtherwise> built_otherwise(const PackOptions& before, const PackOptions& after) {
  if (before.empty() || after.empty()) return {};
  PackOptions both = before;
  both.insert(after.begin(), after.end());
  std::vector<BuiltOtherwise> otherwise;
  for (const auto& [name, ignored] : both) {
    if (value_of(before, name) != value_of(after, name))
      otherwise.push_back({name, value_of(before, name), value_of(after, name)});
  }
  return otherwise;
}

nlohmann::json to_json(const std::vector<BuiltOtherwise>& options) {
  nlohmann::json all = nlohmann::json::array();
  for (const BuiltOtherwise& option : options)
    all.push_back(
        {{"option", option.option}, {"before", json_of(option.before)}, {"after", json_of(option.after)}});
  return all;
}

std::string told(const std::vector<BuiltOtherwise>& options) {
  if (options.empty()) return "";
  std::string words;
  bool of_the_model = false;
  for (const BuiltOtherwise& option : options) {
    words += fmt::format("{}--{} {}, before {}", words.empty() ? "" : "; ", option.option,
                         option.after.value_or("by default"), option.before.value_or("by default"));
    of_the_model = of_the_model || changes_the_model(option.option);
  }
  return fmt::format("\nthe packs were built with different options ({}){}\n", words,
                     of_the_model ? ": what is reshaped, added or removed may come from that alone"
                                  : ", which change nothing at full detail");
}

}  // namespace triptych
