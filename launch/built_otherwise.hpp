// With which options two packs were built differently.
#pragma once

#include "scene/pack_options.hpp"

#include <nlohmann/json.hpp>
#include <optional>

namespace triptych {

/// An option of two builds that is not the same; none where a pack was built without it.
struct BuiltOtherwise {
  std::string option;  ///< "keep"
  std::optional<std::string> before, after;
};

/// Nothing where a pack does not say how it was built.
std::vector<BuiltOtherwise> built_otherwise(const PackOptions& before, const PackOptions& after);

/// [{"option", "before", "after"}], null where there is none.
nlohmann::json to_json(const std::vector<BuiltOtherwise>& options);
/// A line for people who read of changes, which may come from the builds alone; nothing where there are none.
std::string told(const std::vector<BuiltOtherwise>& options);

}  // namespace triptych
