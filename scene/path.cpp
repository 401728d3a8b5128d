#include "scene/path.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/parse_json.hpp"
#include "base/rounding.hpp"
#include "scene/known_keys.hpp"

#include <cmath>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>

namespace triptych {

namespace {

using nlohmann::json;

double number(const json& value, const std::string& place, const char* key) {
  // JSON has no infinity, but parsers turn 1e999 into one: only finite numbers are accepted here.
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    fail(place, "\"{}\" must be a finite number", key);
  return value.get<double>();
}

template <int count>
glm::vec<count, double> vector(const json& object, const std::string& place, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != count) {
    fail(place, "\"{}\" must be {} numbers", key, count);
  }
  glm::vec<count, double> result;
  for (int i = 0; i < count; ++i) result[i] = number((*found)[static_cast<size_t>(i)], place, key);
  return result;
}

/// known: beside the settings, which are allowed at the top and on a frame.
void expect_keys(const json& object, std::vector<std::string_view> known, const std::string& place) {
  known.insert(known.end(), {"near", "fov_y_degrees", "off_axis", "orthographic_height", "time_seconds"});
  expect_known_keys(object, known, place);
}

void read_settings(const json& object, const std::string& place, PathFrame& frame) {
  const bool orthographic = object.contains("orthographic_height");
  if (orthographic && (object.contains("fov_y_degrees") || object.contains("off_axis"))) {
    fail(place, "give either \"orthographic_height\" or \"fov_y_degrees\" and \"off_axis\", not both");
  }
  if (orthographic) {
    frame.orthographic_height = number(object["orthographic_height"], place, "orthographic_height");
    if (!(*frame.orthographic_height > 0)) fail(place, "\"orthographic_height\" must be positive");
    frame.off_axis.reset();
  }
  if (object.contains("fov_y_degrees")) {
    frame.fov_y_degrees = number(object["fov_y_degrees"], place, "fov_y_degrees");
    if (!(frame.fov_y_degrees > 0 && frame.fov_y_degrees < 180))
      fail(place, "\"fov_y_degrees\" must be between 0 and 180");
    frame.orthographic_height.reset();
  }
  if (object.contains("time_seconds"))
    frame.time_seconds = number(object["time_seconds"], place, "time_seconds");
  if (object.contains("near")) frame.near = number(object["near"], place, "near");
  if (object.contains("off_axis")) {
    frame.off_axis = vector<4>(object, place, "off_axis");
    frame.orthographic_height.reset();
  }
}

}  // namespace

View Path::view(size_t i, int width, int height, double default_near) const {
  const PathFrame& frame = frames[i];
  View view{
      .camera = {.eye = frame.eye, .target = frame.target, .up = frame.up}, .width = width, .height = height};
  const double aspect = static_cast<double>(width) / height;
  if (frame.orthographic_height) {
    set_orthographic_height(view.camera, *frame.orthographic_height, aspect);
  } else {
    set_field_of_view(view.camera, frame.fov_y_degrees, aspect);
  }
  view.camera.near = frame.near.value_or(default_near);
  if (frame.off_axis) {
    view.camera.left = frame.off_axis->x;
    view.camera.right = frame.off_axis->y;
    view.camera.bottom = frame.off_axis->z;
    view.camera.top = frame.off_axis->w;
  }
  return view;
}

namespace {

Path parse(const std::string& text, const std::string& place) {
  const json document = parse_json(text, place);
  if (!document.is_object() || !document.contains("triptych_path"))
    fail(place, "is not a camera path (\"triptych_path\": 1 is missing)");
  if (document["triptych_path"] != 1)
    fail(place, "is a camera path of a version that this program does not know");
  const auto frames = document.find("frames");
  if (frames == document.end() || !frames->is_array() || frames->empty())
    fail(place, "the path has no frames");
  expect_keys(document, {"triptych_path", "frames"}, place);
  PathFrame defaults;
  read_settings(document, place, defaults);
  Path path;
  for (const json& object : *frames) {
    const std::string frame_place = fmt::format("{} frame {}", place, path.frames.size());
    if (!object.is_object()) fail(frame_place, "must be an object");
    expect_keys(object, {"eye", "target", "up"}, frame_place);
    PathFrame frame = defaults;
    frame.eye = vector<3>(object, frame_place, "eye");
    frame.target = vector<3>(object, frame_place, "target");
    frame.up = vector<3>(object, frame_place, "up");
    read_settings(object, frame_place, frame);
    path.frames.push_back(frame);
    check_camera(path.view(path.frames.size() - 1, 1, 1, 1).camera, frame_place);
  }
  return path;
}

}  // namespace

Path load_path(const std::filesystem::path& file) { return parse_path(read_text_file(file), file.string()); }

Path parse_path(const std::string& text, const std::string& place) {
  return round_to_nearest([&] { return parse(text, place); });
}

std::string path_text(const Path& path) {
  const auto list = [](const auto& vector) {
    nlohmann::ordered_json numbers;
    for (int i = 0; i < vector.length(); ++i) numbers.push_back(vector[i]);
    return numbers;
  };
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  for (const PathFrame& frame : path.frames) {
    nlohmann::ordered_json object = {
        {"eye", list(frame.eye)}, {"target", list(frame.target)}, {"up", list(frame.up)}};
    if (frame.orthographic_height) {
      object["orthographic_height"] = *frame.orthographic_height;
    } else {
      object["fov_y_degrees"] = frame.fov_y_degrees;
    }
    if (frame.off_axis) object["off_axis"] = list(*frame.off_axis);
    if (frame.near) object["near"] = *frame.near;
    if (frame.time_seconds) object["time_seconds"] = *frame.time_seconds;
    frames.push_back(std::move(object));
  }
  return nlohmann::ordered_json{{"triptych_path", 1}, {"frames", std::move(frames)}}.dump(1) + "\n";
}

}  // namespace triptych
