#include "view/viewpoint.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <fmt/core.h>
#include <set>

namespace triptych {

namespace {

/// 22 letters, of which the first stands for 2 bits and each other for 6.
bool is_ifc_guid(std::string_view text) {
  return text.size() == 22 && std::all_of(text.begin(), text.end(), [](char letter) {
           return (letter >= '0' && letter <= '9') || (letter >= 'A' && letter <= 'Z') ||
                  (letter >= 'a' && letter <= 'z') || letter == '_' || letter == '$';
         });
}

/// The IFC GUIDs of those that have one.
std::vector<std::string> ifc_guids(const SourceObjects& source, std::span<const SourceObjectId> objects) {
  std::vector<std::string> guids;
  for (const SourceObjectId id : objects) {
    const std::string_view guid = source.texts[source.objects[id].guid];
    if (is_ifc_guid(guid)) guids.emplace_back(guid);
  }
  return guids;
}

/// What is hidden, or what is not if that is less.
struct Named {
  bool are_hidden = true;
  ObjectSet objects;
};
Named named_of(const FrameState& frame, const SourceObjects& source) {
  const HiddenObjects* const hidden = frame.hiding.objects.get();
  if (!hidden) return {};
  if (2 * hidden->objects().size() <= source.objects.size()) return {true, hidden->objects()};
  return {false, all_but(source, hidden->objects())};
}

}  // namespace

std::vector<SourceObjectId> objects_of(const SourceObjects& source, std::span<const std::string> guids) {
  const std::set<std::string_view> wanted(guids.begin(), guids.end());
  std::vector<SourceObjectId> found;
  for (SourceObjectId id = 0; id < source.objects.size(); ++id) {
    const std::string_view guid = source.texts[source.objects[id].guid];
    if (!guid.empty() && wanted.count(guid) > 0) found.push_back(id);
  }
  return found;
}

Viewpoint viewpoint_of(const PathFrame& camera, const FrameState& frame, const SourceObjects& source,
                       const Selected& selected, const std::string& title) {
  Viewpoint viewpoint;
  viewpoint.title = title;
  viewpoint.camera = camera;
  viewpoint.planes = planes_of(frame.section);
  const std::vector<SourceObjectId> objects = selected.objects();
  viewpoint.selected = ifc_guids(source, objects);
  if (!objects.empty()) viewpoint.title += ": " + selected.name();
  const Named named = named_of(frame, source);
  viewpoint.shows_others = named.are_hidden;
  viewpoint.exceptions = ifc_guids(source, named.objects);
  return viewpoint;
}

std::string not_saved_text(const FrameState& frame, const SourceObjects& source, const Selected& selected) {
  std::string text;
  const auto count = [&](std::span<const SourceObjectId> objects, const char* what) {
    const size_t without = objects.size() - ifc_guids(source, objects).size();
    if (without == 0) return;
    text += fmt::format("{}{} of {} objects that are {}", text.empty() ? "" : ", ", without, objects.size(),
                        what);
  };
  const Named named = named_of(frame, source);
  count(selected.objects(), "selected");
  count(named.objects, named.are_hidden ? "hidden" : "shown");
  return text.empty() ? text : text + ": they have no IFC GUID";
}

ObjectSet hidden_by(const Viewpoint& viewpoint, const SourceObjects& source) {
  ObjectSet named = with_contents(source, objects_of(source, viewpoint.exceptions));
  return viewpoint.shows_others ? named : all_but(source, named);
}

std::string left_out_text(const Viewpoint& viewpoint, const SourceObjects& source) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  for (const std::string& what : viewpoint.left_out) add(what);
  const size_t named = std::set(viewpoint.exceptions.begin(), viewpoint.exceptions.end()).size();
  const size_t known = objects_of(source, viewpoint.exceptions).size();
  if (known < named) {
    add(fmt::format("{} of {} objects that are {}, which the model does not have", named - known, named,
                    viewpoint.shows_others ? "hidden" : "shown"));
  }
  return text;
}

std::string time_text() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  const size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return {text.data(), length};
}

}  // namespace triptych
