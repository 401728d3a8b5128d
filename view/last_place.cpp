#include "view/last_place.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/notice.hpp"
#include "base/parse_json.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace triptych {

namespace {
constexpr double least_pause_s = 0.25;

nlohmann::json numbers(const glm::dvec3& vector) { return {vector.x, vector.y, vector.z}; }
glm::dvec3 vector_of(const nlohmann::json& json, size_t first) {
  return {json.at(first).get<double>(), json.at(first + 1).get<double>(), json.at(first + 2).get<double>()};
}

nlohmann::json to_json(const Section& section) {
  nlohmann::json json = {{"planes", nlohmann::json::array()}, {"box", nlohmann::json::array()}};
  for (const SectionPlane& plane : section.planes()) {
    json["planes"].push_back(numbers(plane.normal));
    json["planes"].back().push_back(plane.offset);
  }
  if (section.box()) {
    json["box"] = numbers(section.box()->lo);
    for (int axis = 0; axis < 3; ++axis) json["box"].push_back(section.box()->hi[axis]);
  }
  return json;
}

Section section_of(const nlohmann::json& json, const std::string& place) {
  Section section;
  for (const nlohmann::json& plane : json.at("planes"))
    section.add_plane({vector_of(plane, 0), plane.at(3).get<double>()}, place);
  if (!json.at("box").empty()) section.set_box({vector_of(json["box"], 0), vector_of(json["box"], 3)}, place);
  return section;
}

/// The first of each run of ids, and how many.
nlohmann::json runs_of(const ObjectSet& objects) {
  nlohmann::json runs = nlohmann::json::array();
  for (size_t i = 0; i < objects.size();) {
    size_t end = i + 1;
    while (end < objects.size() && objects[end] == objects[end - 1] + 1) ++end;
    runs.push_back({objects[i], end - i});
    i = end;
  }
  return runs;
}

ObjectSet objects_of_runs(const nlohmann::json& runs, const std::string& place) {
  ObjectSet objects;
  for (const nlohmann::json& run : runs) {
    const auto first = run.at(0).get<uint64_t>(), count = run.at(1).get<uint64_t>();
    const uint64_t least = objects.empty() ? 0 : uint64_t{objects.back()} + 1;
    if (first < least || count == 0 || first >= no_id || count > no_id - first)
      fail(place, "\"hidden\" has runs that are out of order");
    for (uint64_t i = 0; i < count; ++i) objects.push_back(static_cast<SourceObjectId>(first + i));
  }
  return objects;
}

nlohmann::json to_json(const Picked& picked) {
  return {picked.drawable, picked.placement, picked.triangle, numbers(picked.point), numbers(picked.normal)};
}

Picked picked_of(const nlohmann::json& json) {
  return {json.at(0).get<DrawableId>(), json.at(1).get<uint32_t>(), json.at(2).get<uint32_t>(),
          vector_of(json.at(3), 0), vector_of(json.at(4), 0)};
}

nlohmann::json to_json(const Measured& measured) {
  nlohmann::json json = {
      {"points", nlohmann::json::array()}, {"closed", measured.closed}, {"to_face", nullptr}};
  for (const glm::dvec3& point : measured.points) json["points"].push_back(numbers(point));
  if (measured.to_face) json["to_face"] = *measured.to_face;
  return json;
}

Measured measured_of(const nlohmann::json& json, const std::string& place) {
  Measured measured;
  for (const nlohmann::json& point : json.at("points")) measured.points.push_back(vector_of(point, 0));
  measured.closed = json.at("closed").get<bool>();
  if (measured.closed && measured.points.size() < 3)
    fail(place, "\"measured\" has a polygon of fewer than three points");
  if (!json.at("to_face").is_null()) measured.to_face = json["to_face"].get<double>();
  return measured;
}

}  // namespace

std::string last_place_text(const LastPlace& place) {
  nlohmann::json json = {{"camera", path_text({{place.camera}})},
                         {"pace", place.pace},
                         {"pixel_error", place.pixel_error},
                         {"edges", place.edges},
                         {"culling", place.culling},
                         {"selected", place.selected},
                         {"section", to_json(place.section)},
                         {"hidden", runs_of(place.hidden)}};
  for (const char* list : {"picked", "measured"}) json[list] = nlohmann::json::array();
  for (const Picked& picked : place.picked) json["picked"].push_back(to_json(picked));
  for (const Measured& measured : place.measured) json["measured"].push_back(to_json(measured));
  return json.dump() + "\n";
}

LastPlace parse_last_place(const std::string& text, const std::string& place) {
  try {
    const nlohmann::json json = parse_json(text, place);
    LastPlace last;
    last.camera = parse_path(json.at("camera").get<std::string>(), place).frames.front();
    last.pace = json.at("pace").get<double>();
    last.pixel_error = json.at("pixel_error").get<double>();
    last.edges = json.at("edges").get<bool>();
    last.culling = json.at("culling").get<bool>();
    last.selected = json.at("selected").get<std::vector<SourceObjectId>>();
    for (const nlohmann::json& picked : json.at("picked")) last.picked.push_back(picked_of(picked));
    for (const nlohmann::json& measured : json.at("measured"))
      last.measured.push_back(measured_of(measured, place));
    last.section = section_of(json.at("section"), place);
    last.hidden = objects_of_runs(json.at("hidden"), place);
    if (!(last.pace > 0 && std::isfinite(last.pace))) fail(place, "\"pace\" must be positive");
    if (!(last.pixel_error >= 0 && std::isfinite(last.pixel_error)))
      fail(place, "\"pixel_error\" must not be negative");
    return last;
  } catch (const nlohmann::json::exception& error) {
    fail(place, "is no place of a person: {}", in_words(error));
  }
}

std::optional<LastPlace> PlaceKeeper::read() const {
  std::error_code error;
  if (!wanted() || !std::filesystem::exists(file_, error)) return std::nullopt;
  try {
    return parse_last_place(read_text_file(file_), file_.string());
  } catch (const Error& damage) {
    notice("begins at the start: {}", damage.what());
    return std::nullopt;
  }
}

bool PlaceKeeper::keep(const LastPlace& place) {
  if (!wanted() || failed_) return true;
  if (!kept_.empty() && since_.seconds() < least_pause_s) return false;
  std::string text = last_place_text(place);
  if (text == kept_) return true;
  // Whole, whenever this process is killed; that a machine is, is not what it is for, so no disk is waited
  // for.
  const std::filesystem::path partial = file_.string() + ".new";
  std::ofstream(partial) << text << std::flush;
  std::error_code error;
  std::filesystem::rename(partial, file_, error);
  if (error) notice("{}: cannot be written: {}", file_.string(), error.message());
  failed_ = static_cast<bool>(error);
  kept_ = std::move(text);
  since_.restart();
  return true;
}

}  // namespace triptych
