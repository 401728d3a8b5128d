// Source objects for people and as JSON.
#pragma once

#include "scene/pack.hpp"
#include "scene/pack_objects.hpp"

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// "id", "scene_nodes" (ids of leaves), and where the file says them "name", "type", "layer", "storey",
/// "guid", "number", "parent" (an id), "path" and "properties" {set: {name: value}}.
nlohmann::json to_json(const PackObjects& objects, SourceObjectId id);

/// A table of the first objects, one line each, without columns that all of them lack.
std::string object_table(const PackObjects& objects, std::span<const SourceObjectId> ids);

/// Prints the objects that the word means (scene/object_words.hpp), and adds them to the description:
/// "source_object_count" and "source_objects". Returns how many they are.
size_t list_objects(const Pack& pack, const std::string& find, nlohmann::json& description);

}  // namespace triptych
