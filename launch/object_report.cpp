#include "launch/object_report.hpp"

#include "base/one_line.hpp"
#include "launch/text_table.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/core.h>

namespace triptych {

namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return lower;
}

/// In one line, and no longer than so many bytes; whole letters of UTF-8.
std::string cell(std::string_view text, size_t most) {
  if (text.size() > most) {
    size_t end = most - 3;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
    return one_line(std::string(text.substr(0, end))) + "...";
  }
  return one_line(std::string(text));
}

struct Member {
  const char* name;
  uint32_t SourceObject::*text;
};
constexpr std::array members = {
    Member{"name", &SourceObject::name},   Member{"type", &SourceObject::type},
    Member{"layer", &SourceObject::layer}, Member{"storey", &SourceObject::storey},
    Member{"guid", &SourceObject::guid},   Member{"number", &SourceObject::number}};

}  // namespace

std::vector<SourceObjectId> find_objects(const SourceObjects& source, std::string_view text) {
  const std::string wanted = lower_case(text);
  std::vector<bool> holds(source.texts.size());
  for (uint32_t i = 0; i < holds.size(); ++i)
    holds[i] = lower_case(source.texts[i]).find(wanted) != std::string::npos;
  std::vector<bool> set_holds(source.sets.size());
  for (uint32_t i = 0; i < set_holds.size(); ++i) {
    const auto properties = source.properties_of(i);
    set_holds[i] = std::any_of(properties.begin(), properties.end(),
                               [&](const SourceProperty& property) { return holds[property.value]; });
  }
  std::vector<SourceObjectId> found;
  for (SourceObjectId id = 0; id < source.objects.size(); ++id) {
    const auto sets = source.sets_of(id);
    if (std::any_of(members.begin(), members.end(),
                    [&](const Member& member) { return holds[source.objects[id].*member.text]; }) ||
        std::any_of(sets.begin(), sets.end(), [&](uint32_t set) { return set_holds[set]; }))
      found.push_back(id);
  }
  return found;
}

nlohmann::json to_json(const PackObjects& objects, SourceObjectId id) {
  const SourceObjects& source = objects.source();
  const SourceObject& object = source.objects[id];
  nlohmann::json json = {{"id", id}};
  for (const Member& member : members) {
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
  std::vector<Member> columns;
  for (const Member& member : members) {
    if (std::any_of(shown.begin(), shown.end(),
                    [&](SourceObjectId id) { return source.objects[id].*member.text != 0; }))
      columns.push_back(member);
  }
  std::vector<std::string> head = {"id"};
  for (const Member& column : columns) head.emplace_back(column.name);
  head.emplace_back("scene nodes");
  std::vector<std::vector<std::string>> rows;
  for (const SourceObjectId id : shown) {
    std::vector<std::string> row = {std::to_string(id)};
    for (const Member& column : columns)
      row.push_back(cell(source.texts[source.objects[id].*column.text], longest));
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

std::string object_text(const PackObjects& objects, SourceObjectId id) {
  constexpr size_t most_properties = 20, longest = 120;
  const SourceObjects& source = objects.source();
  const SourceObject& object = source.objects[id];
  const auto text_of = [&](uint32_t text) { return cell(source.texts[text], longest); };
  std::string text = fmt::format("  object {}: {}", id, object.name == 0 ? "no name" : text_of(object.name));
  for (const Member& member : std::span(members).subspan(1)) {
    if (object.*member.text != 0) text += fmt::format(", {} {}", member.name, text_of(object.*member.text));
  }
  text += "\n";
  if (const std::string path = source.path_of(id); !path.empty())
    text += fmt::format("    in {}\n", cell(path, longest));
  size_t left_out = 0, printed = 0;
  for (const uint32_t set : source.sets_of(id)) {
    for (const SourceProperty& property : source.properties_of(set)) {
      if (++printed > most_properties) {
        ++left_out;
        continue;
      }
      text += fmt::format("    {}: {} = {}\n", text_of(source.sets[set].name), text_of(property.name),
                          text_of(property.value));
    }
  }
  if (left_out > 0) text += fmt::format("    and {} more properties\n", left_out);
  return text;
}

}  // namespace triptych
