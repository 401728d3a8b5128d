#include "launch/object_report.hpp"

#include "base/one_line.hpp"
#include "launch/file_report.hpp"
#include "launch/text_table.hpp"
#include "scene/file_objects.hpp"
#include "scene/object_text.hpp"
#include "scene/object_words.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

nlohmann::json to_json(const PackObjects& objects, SourceObjectId id) {
  const SourceObjects& source = objects.source();
  const SourceObject& object = source.objects[id];
  nlohmann::json json = {{"id", id}};
  for (const ObjectText& member : object_texts) {
    if (object.*member.text != 0) json[member.name] = std::string(source.texts[object.*member.text]);
  }
  if (object.parent != no_id) json["parent"] = object.parent;
  if (const std::string path = source.path_of(id); !path.empty()) json["path"] = path;
  for (const uint32_t set : source.sets_of(id)) {
    nlohmann::json& into = json["properties"][std::string(source.texts[source.sets[set].name])];
    for (const SourceProperty& property : source.properties_of(set))
      into[std::string(source.texts[property.name])] = std::string(source.texts[property.value]);
  }
  const auto nodes = objects.nodes_of(id);
  json["scene_nodes"] = std::vector<SceneNodeId>(nodes.begin(), nodes.end());
  return json;
}

std::string object_table(const PackObjects& objects, std::span<const SourceObjectId> ids) {
  constexpr size_t most = 40, longest = 36;
  const SourceObjects& source = objects.source();
  const auto shown = ids.first(std::min(most, ids.size()));
  std::vector<ObjectText> columns;
  for (const ObjectText& member : object_texts) {
    if (std::any_of(shown.begin(), shown.end(),
                    [&](SourceObjectId id) { return source.objects[id].*member.text != 0; }))
      columns.push_back(member);
  }
  std::vector<std::string> head = {"id"};
  for (const ObjectText& column : columns) head.emplace_back(column.name);
  const std::vector<SourceObjectId> files = file_objects(source);
  const std::vector<uint32_t> file_of = files_of_objects(source);
  if (!files.empty()) head.emplace_back("file");
  head.emplace_back("scene nodes");
  std::vector<std::vector<std::string>> rows;
  for (const SourceObjectId id : shown) {
    std::vector<std::string> row = {std::to_string(id)};
    for (const ObjectText& column : columns)
      row.push_back(in_one_cell(source.texts[source.objects[id].*column.text], longest));
    if (!files.empty())
      row.push_back(in_one_cell(source.texts[source.objects[files[file_of[id]]].name], longest));
    row.push_back(in_threes(static_cast<double>(objects.nodes_of(id).size())));
    rows.push_back(std::move(row));
  }
  std::string text = text_table(head, rows);
  if (ids.size() > shown.size()) {
    text += fmt::format("and {} more: --find TEXT shows fewer, --json FILE has all\n",
                        in_threes(static_cast<double>(ids.size() - shown.size())));
  }
  return text;
}

size_t list_objects(const Pack& pack, const std::string& find, nlohmann::json& description) {
  const PackObjects objects = pack.read_objects();
  const std::vector<SourceObjectId> found = ObjectFinder(objects.source()).find(find);
  fmt::print("{} objects", in_threes(static_cast<double>(objects.source().objects.size())));
  if (!find.empty())
    fmt::print(", {} with \"{}\"", in_threes(static_cast<double>(found.size())), one_line(find));
  fmt::print("\n");
  const std::vector<FileShare> files = file_shares(pack, objects);
  if (!files.empty() && find.empty()) fmt::print("\n{}", file_table(files));
  description["files"] = to_json(files);
  if (!found.empty()) fmt::print("\n{}", object_table(objects, found));
  description["source_object_count"] = objects.source().objects.size();
  nlohmann::json& list = description["source_objects"] = nlohmann::json::array();
  for (const SourceObjectId id : found) list.push_back(to_json(objects, id));
  return found.size();
}

}  // namespace triptych
