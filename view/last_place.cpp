#include "view/last_place.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/notice.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace triptych {

namespace {
constexpr double least_pause_s = 0.25;
}  // namespace

std::string last_place_text(const LastPlace& place) {
  const nlohmann::json json = {{"camera", path_text({{place.camera}})},
                               {"pace", place.pace},
                               {"pixel_error", place.pixel_error},
                               {"edges", place.edges},
                               {"culling", place.culling},
                               {"selected", place.selected}};
  return json.dump() + "\n";
}

LastPlace parse_last_place(const std::string& text, const std::string& place) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    LastPlace last;
    last.camera = parse_path(json.at("camera").get<std::string>(), place).frames.front();
    last.pace = json.at("pace").get<double>();
    last.pixel_error = json.at("pixel_error").get<double>();
    last.edges = json.at("edges").get<bool>();
    last.culling = json.at("culling").get<bool>();
    last.selected = json.at("selected").get<SourceObjectId>();
    if (!(last.pace > 0 && std::isfinite(last.pace))) fail(place, "\"pace\" must be positive");
    if (!(last.pixel_error >= 0 && std::isfinite(last.pixel_error)))
      fail(place, "\"pixel_error\" must not be negative");
    return last;
  } catch (const nlohmann::json::exception& error) {
    fail(place, "is no place of a person: {}", error.what());
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
  std::string text = last_place_text(place);
  if (text == kept_) return true;
  if (!kept_.empty() && since_.seconds() < least_pause_s) return false;
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
