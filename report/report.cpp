#include "report/report.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/parse_json.hpp"
#include "scene/known_keys.hpp"
#include "scene/path.hpp"

#include <fmt/core.h>

namespace triptych {

using nlohmann::json;

namespace {

json read_json(const std::filesystem::path& file) {
  json document = parse_json(read_text_file(file), file.string());
  if (!document.is_object()) fail(file.string(), "does not hold a JSON object");
  return document;
}

std::string member(const json& object, const char* key, const std::string& place) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end() || !found->is_string())
    fail(place, "has no text \"{}\"", key);
  return found->get<std::string>();
}

/// The array of that name; an empty one where there is none.
json list(const json& object, const char* key, const std::string& place) {
  const json items = object.value(key, json::array());
  if (!items.is_array()) fail(place, "\"{}\" is not a list", key);
  return items;
}

/// Where a picture was taken: "eye at 1.50, 1.60, -20.00, looking at 1.50, 1.60, -10.00".
std::string place_of_eye(const json& item, const std::filesystem::path& folder, const std::string& place) {
  const json frame = item.value("frame", json());
  if (!frame.is_number_unsigned()) fail(place, "has no whole number \"frame\"");
  const std::filesystem::path file = folder / member(item, "path", place);
  const Path path = load_path(file);
  if (frame.get<size_t>() >= path.frames.size())
    fail(file.string(), "has no frame {}: it has {}", frame.get<size_t>(), path.frames.size());
  const auto& [eye, target] =
      std::pair(path.frames[frame.get<size_t>()].eye, path.frames[frame.get<size_t>()].target);
  return fmt::format("frame {} of {}, eye at {:.2f}, {:.2f}, {:.2f}, looking at {:.2f}, {:.2f}, {:.2f}",
                     frame.get<size_t>(), file.filename().string(), eye.x, eye.y, eye.z, target.x, target.y,
                     target.z);
}

}  // namespace

void name_pictures_beside_page(Report& report) {
  for (size_t i = 0; i < report.pictures.size(); ++i)
    report.pictures[i].file =
        fmt::format("report-pictures/{}-{}", i + 1, report.pictures[i].source.filename().string());
}

void copy_pictures(const Report& report, const std::filesystem::path& folder) {
  for (const ReportPicture& picture : report.pictures) {
    make_folder((folder / picture.file).parent_path());
    write_file(folder / picture.file, read_text_file(picture.source));
  }
}

double ReportEntry::figure(const std::string& pointer) const {
  const json::json_pointer key(pointer);
  if (!figures.contains(key) || !figures.at(key).is_number())
    fail(file.string(), "has no number at {}", pointer);
  return figures.at(key).get<double>();
}

std::string ReportEntry::text(const std::string& pointer) const {
  const json::json_pointer key(pointer);
  if (!figures.contains(key) || !figures.at(key).is_string())
    fail(file.string(), "has no text at {}", pointer);
  return figures.at(key).get<std::string>();
}

std::vector<double> ReportEntry::numbers(const std::string& pointer) const {
  const json::json_pointer key(pointer);
  if (!figures.contains(key) || !figures.at(key).is_array())
    fail(file.string(), "has no list at {}", pointer);
  std::vector<double> values;
  for (const json& value : figures.at(key)) {
    if (!value.is_number()) fail(file.string(), "has something other than numbers at {}", pointer);
    values.push_back(value.get<double>());
  }
  return values;
}

const ReportEntry* Report::find(const std::string& name) const {
  for (const ReportEntry& entry : entries) {
    if (entry.name == name) return &entry;
  }
  return nullptr;
}

Report load_report(const std::filesystem::path& manifest) {
  const std::string place = manifest.string();
  const json document = read_json(manifest);
  const std::filesystem::path folder = manifest.parent_path();
  Report report;
  report.title = member(document, "title", place);
  expect_known_keys(document, {"title", "note", "held_to", "entries", "pictures"}, place);
  if (document.contains("note")) report.note = member(document, "note", place);
  if (document.contains("held_to")) {
    const std::string held_to = member(document, "held_to", place);
    if (held_to != "exactness" && held_to != "everything")
      fail(place, "\"held_to\" is neither \"everything\" nor \"exactness\"");
    report.held_to_exactness_alone = held_to == "exactness";
  }
  for (const json& item : list(document, "entries", place)) {
    ReportEntry entry{.name = member(item, "name", place),
                      .command = member(item, "command", place),
                      .file = folder / member(item, "json", place),
                      .figures = {}};
    expect_known_keys(item, {"name", "command", "json"}, place + ": entry " + entry.name);
    if (report.find(entry.name)) fail(place, "names \"{}\" twice", entry.name);
    entry.figures = read_json(entry.file);
    report.entries.push_back(std::move(entry));
  }
  if (report.entries.empty()) fail(place, "names no entries");
  for (const json& item : list(document, "pictures", place)) {
    const std::string file = member(item, "file", place);
    report.pictures.push_back({.file = file,
                               .caption = member(item, "caption", place),
                               .command = member(item, "command", place),
                               .source = folder / file});
    const std::string here = place + ": picture " + file;
    expect_known_keys(item, {"file", "caption", "command", "path", "frame"}, here);
    if (!std::filesystem::is_regular_file(folder / file)) fail((folder / file).string(), "is not there");
    if (item.contains("path") || item.contains("frame"))
      report.pictures.back().caption += "; " + place_of_eye(item, folder, here);
  }
  return report;
}

}  // namespace triptych
