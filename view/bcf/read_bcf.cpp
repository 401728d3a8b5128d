#include "base/error.hpp"
#include "base/rounding.hpp"
#include "view/bcf/bcf.hpp"
#include "view/bcf/xml_tree.hpp"
#include "view/bcf/zip_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

/// BCF's z up to the pack's y up.
glm::dvec3 to_model(const glm::dvec3& bcf) { return {bcf.x, bcf.z, -bcf.y}; }

double number(const XmlElement& parent, const char* name, const std::string& place) {
  const XmlElement* element = parent.child(name);
  if (!element) fail(place, "<{}> has no <{}>", parent.name, name);
  double value = 0;
  const std::string& text = element->text;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    fail(place, "<{}> of <{}> is no finite number: \"{}\"", name, parent.name, text.substr(0, 40));
  return value;
}

glm::dvec3 vector(const XmlElement& parent, const char* name, const std::string& place) {
  const XmlElement* element = parent.child(name);
  if (!element) fail(place, "<{}> has no <{}>", parent.name, name);
  return to_model({number(*element, "X", place), number(*element, "Y", place), number(*element, "Z", place)});
}

/// Of length 1; of any but zero, however long or short.
glm::dvec3 unit(const glm::dvec3& direction) {
  const glm::dvec3 size = glm::abs(direction);
  return glm::normalize(direction / std::max({size.x, size.y, size.z}));
}

PathFrame read_camera(const XmlElement& view, const std::string& place) {
  const XmlElement* perspective = view.child("PerspectiveCamera");
  const XmlElement* orthogonal = view.child("OrthogonalCamera");
  if (!perspective && !orthogonal) fail(place, "has no camera");
  const XmlElement& camera = perspective ? *perspective : *orthogonal;
  PathFrame frame;
  frame.eye = vector(camera, "CameraViewPoint", place);
  const glm::dvec3 direction = vector(camera, "CameraDirection", place);
  if (direction == glm::dvec3(0)) fail(place, "the camera has no direction");
  frame.target = frame.eye + unit(direction);
  if (frame.target == frame.eye) fail(place, "the camera is too far away for its direction to be computed");
  frame.up = vector(camera, "CameraUpVector", place);
  if (perspective) {
    frame.fov_y_degrees = number(camera, "FieldOfView", place);
    if (!(frame.fov_y_degrees > 0 && frame.fov_y_degrees < 180))
      fail(place, "<FieldOfView> must be between 0 and 180 degrees");
  } else {
    frame.orthographic_height = number(camera, "ViewToWorldScale", place);
    if (!(*frame.orthographic_height > 0)) fail(place, "<ViewToWorldScale> must be positive");
  }
  check_camera(Path{{frame}}.view(0, 1, 1, 1).camera, place);
  return frame;
}

std::vector<std::string> guids(const XmlElement* list) {
  std::vector<std::string> found;
  if (!list) return found;
  for (const XmlElement* component : list->all("Component")) {
    if (std::string guid = component->attribute("IfcGuid"); !guid.empty()) found.push_back(std::move(guid));
  }
  return found;
}

Viewpoint read_viewpoint(const XmlElement& view, const std::string& place) {
  if (view.name != "VisualizationInfo") fail(place, "is no viewpoint: its root is <{}>", view.name);
  Viewpoint viewpoint;
  viewpoint.camera = read_camera(view, place);
  if (const XmlElement* components = view.child("Components")) {
    viewpoint.selected = guids(components->child("Selection"));
    if (const XmlElement* visibility = components->child("Visibility")) {
      const std::string shown = visibility->attribute("DefaultVisibility");
      viewpoint.shows_others = shown == "true" || shown == "1";  // false where it is missing, as specified
      viewpoint.exceptions = guids(visibility->child("Exceptions"));
    }
    const XmlElement* colors = components->child("Coloring");
    if (colors && !colors->children.empty()) viewpoint.left_out.emplace_back("colours");
  }
  if (const XmlElement* planes = view.child("ClippingPlanes")) {
    for (const XmlElement* plane : planes->all("ClippingPlane")) {
      const glm::dvec3 location = vector(*plane, "Location", place), cut = vector(*plane, "Direction", place);
      if (cut == glm::dvec3(0)) fail(place, "a clipping plane has no direction");
      const glm::dvec3 normal = -unit(cut);  // BCF's points to what is cut away
      viewpoint.planes.push_back({normal, glm::dot(normal, location)});
    }
  }
  const XmlElement *lines = view.child("Lines"), *bitmaps = view.child("Bitmaps");
  if (lines && !lines->children.empty()) viewpoint.left_out.emplace_back("lines");
  if ((bitmaps && !bitmaps->children.empty()) || view.child("Bitmap"))
    viewpoint.left_out.emplace_back("bitmaps");
  return viewpoint;
}

/// The viewpoint files that a topic names: 2.1 lists them beside the topic, 3.0 within it.
std::vector<std::string> viewpoint_files(const XmlElement& markup, const std::string& place) {
  if (markup.name != "Markup") fail(place, "is no topic: its root is <{}>", markup.name);
  const XmlElement* topic = markup.child("Topic");
  std::vector<const XmlElement*> entries = markup.all("Viewpoints");
  if (const XmlElement* list = topic ? topic->child("Viewpoints") : nullptr) entries = list->all("ViewPoint");
  std::vector<std::string> files;
  for (const XmlElement* entry : entries) {
    const XmlElement* file = entry->child("Viewpoint");
    if (file && !file->text.empty()) files.push_back(file->text);
  }
  return files;
}

std::vector<Viewpoint> read(const std::filesystem::path& file) {
  constexpr size_t most = 10'000;
  const ZipReader zip(file);
  const std::string place = file.string();
  const auto place_of = [&](const std::string& member) { return fmt::format("{}: {}", place, member); };
  if (!zip.has("bcf.version")) fail(place, "is no BCF: it has no bcf.version");
  const XmlElement version = parse_xml(zip.read("bcf.version"), place_of("bcf.version"));
  const std::string number = version.attribute("VersionId");
  if (number != "2.1" && number != "3.0")
    fail(place_of("bcf.version"), "is of version \"{}\"; versions 2.1 and 3.0 are read",
         number.substr(0, 20));
  std::vector<Viewpoint> viewpoints;
  for (const std::string& member : zip.members()) {
    if (!member.ends_with("/markup.bcf")) continue;
    const std::string folder = member.substr(0, member.rfind('/') + 1);
    const XmlElement markup = parse_xml(zip.read(member), place_of(member));
    const XmlElement* topic = markup.child("Topic");
    const XmlElement* title = topic ? topic->child("Title") : nullptr;
    for (const std::string& name : viewpoint_files(markup, place_of(member))) {
      if (viewpoints.size() == most) fail(place, "has more than {} viewpoints", most);
      const std::string view = folder + name;
      viewpoints.push_back(read_viewpoint(parse_xml(zip.read(view), place_of(view)), place_of(view)));
      viewpoints.back().title = title ? title->text : "";
    }
  }
  if (viewpoints.empty()) fail(place, "has no viewpoints");
  return viewpoints;
}

}  // namespace

std::vector<Viewpoint> read_bcf(const std::filesystem::path& file) {
  return round_to_nearest([&] { return read(file); });
}

}  // namespace triptych
