// What reports say of solids.
#pragma once

#include "scene/solid_objects.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace triptych {

/// {"placements", "solid_placements", "objects", "solid_objects"}.
nlohmann::json to_json(const SolidCounts& counts);
/// One line for people.
std::string in_words(const SolidCounts& counts);
/// Prints that, and adds {"solids"} to a description: null, and why instead of the line, where something in
/// the pack is damaged.
void list_solids(const Pack& pack, nlohmann::json& description);

}  // namespace triptych
