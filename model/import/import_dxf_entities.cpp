// Entities of DXF that are surfaces or place blocks.
#include "base/one_line.hpp"
#include "model/import/import_dxf.hpp"
#include "model/import/triangulate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>

namespace triptych {

std::string dxf_lower_case(std::string_view name) {
  std::string text(name);
  for (char& letter : text) letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter + 32) : letter;
  return text;
}

uint32_t DxfDrawing::layer_number(std::string_view name) {
  const auto [found, added] =
      layer_numbers.try_emplace(dxf_lower_case(name), static_cast<uint32_t>(layers.size()));
  if (added) layers.push_back({.name = std::string(name)});
  return found->second;
}

Affine dxf_object_axes(const DxfRecord& record) {
  const glm::dvec3 given(record.number(210), record.number(220), record.number(230, record.has(210) ? 0 : 1));
  const double length = glm::length(given);
  if (!(length > 0) || !std::isfinite(length)) return Affine(1);
  const glm::dvec3 z = given / length;
  constexpr double close_to_z = 1.0 / 64;
  const bool close = std::abs(z.x) < close_to_z && std::abs(z.y) < close_to_z;
  const glm::dvec3 x = glm::normalize(glm::cross(close ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1), z));
  return Affine(x, glm::cross(z, x), z, glm::dvec3(0));
}

DxfStyle DxfSurfaces::style_of(const DxfRecord& record, const DxfStyle& otherwise) {
  DxfStyle style = otherwise;
  if (const std::string_view layer = record.text(8); !layer.empty())
    style.layer = drawing_.layer_number(layer);
  if (record.has(62) || record.has(420)) style.color = dxf_color::of_record(record);
  return style;
}

uint32_t DxfSurfaces::add_vertex(const glm::dvec3& position) {
  block_.positions.push_back(position);
  return static_cast<uint32_t>(block_.positions.size() - 1);
}

void DxfSurfaces::add_face(std::span<const uint32_t> corners, const DxfStyle& style) {
  kept_.clear();
  corners_.clear();
  for (const uint32_t corner : corners) {
    const glm::dvec3& position = block_.positions[corner];
    if (!corners_.empty() && (corners_.back() == position || corners_.front() == position)) continue;
    kept_.push_back(corner);
    corners_.push_back(position);
  }
  if (kept_.size() < 3) return target_.warn("faces without three different corners were skipped");
  target_.warn(fan_warning, corners_.size() > max_clipped_corners);
  triangulate(corners_, cut_);
  for (const auto& [a, b, c] : cut_) block_.triangles.push_back({{kept_[a], kept_[b], kept_[c]}, style});
}

void DxfSurfaces::add_face(std::span<const glm::dvec3> corners, const DxfStyle& style) {
  std::vector<uint32_t> numbers;
  for (const glm::dvec3& corner : corners) numbers.push_back(add_vertex(corner));
  add_face(numbers, style);
}

namespace {

glm::dvec3 corner(const DxfRecord& entity, int i) {
  return {entity.coordinate(10 + i), entity.coordinate(20 + i), entity.coordinate(30 + i)};
}

void add_3dface(const DxfRecord& entity, const DxfStyle& style, DxfSurfaces& surfaces) {
  std::array<glm::dvec3, 4> corners;
  for (int i = 0; i < 4; ++i) corners[static_cast<size_t>(i)] = corner(entity, i);
  surfaces.add_face(std::span(corners).first(entity.has(13) ? 4 : 3), style);
}

/// SOLID and TRACE: the third and fourth corner change places. With a thickness they are prisms.
void add_solid(const DxfRecord& entity, const DxfStyle& style, DxfSurfaces& surfaces) {
  const Affine axes = dxf_object_axes(entity);
  const double thickness = entity.number(39);
  std::vector<glm::dvec3> outline, top;
  for (const int i : {0, 1, entity.has(13) ? 3 : 2, 2}) {
    const glm::dvec3 point = corner(entity, i);
    outline.emplace_back(axes * glm::dvec4(point, 1));
    top.emplace_back(axes * glm::dvec4(point + glm::dvec3(0, 0, thickness), 1));
  }
  if (outline[2] == outline[3]) outline.pop_back(), top.pop_back();
  surfaces.add_face(outline, style);
  if (thickness == 0) return;
  surfaces.add_face(top, style);
  for (size_t i = 0; i < outline.size(); ++i) {
    const size_t next = (i + 1) % outline.size();
    surfaces.add_face(std::array{outline[i], outline[next], top[next], top[i]}, style);
  }
}

/// MESH: vertices (92), then faces (93) as lists of corners. A subdivision level is drawn as level 0.
void add_mesh(const DxfRecord& entity, const DxfStyle& style, DxfSurfaces& surfaces) {
  const auto first = static_cast<uint32_t>(surfaces.block().positions.size());
  glm::dvec3 position{0};
  uint32_t vertices = 0;
  std::vector<int64_t> lists;  // corners' count, corners, and so on
  enum { before, positions, faces, behind } part = before;
  for (const DxfGroup& group : entity.groups) {
    if (group.code == 92) part = positions;
    if (group.code == 93) part = faces;
    if (group.code == 94) part = behind;
    if (part == positions && group.code == 10) position.x = group.number;
    if (part == positions && group.code == 20) position.y = group.number;
    if (part == positions && group.code == 30) {
      position.z = group.number;
      surfaces.add_vertex(position);
      ++vertices;
    }
    if (part == faces && group.code == 90) lists.push_back(group.integer(-1));  // names no vertex
  }
  if (entity.integer(91) > 0) surfaces.target().warn("meshes are drawn without their subdivision");
  std::vector<uint32_t> corners;
  for (size_t i = 0; i < lists.size();) {
    const int64_t count = lists[i++];
    if (count < 0 || static_cast<uint64_t>(count) > lists.size() - i)
      return surfaces.target().warn("lists of faces end too soon; their rest was skipped");
    corners.clear();
    for (int64_t k = 0; k < count; ++k, ++i) {
      if (lists[i] >= 0 && lists[i] < vertices) corners.push_back(first + static_cast<uint32_t>(lists[i]));
    }
    if (corners.size() == static_cast<size_t>(count)) {
      surfaces.add_face(corners, style);
    } else {
      surfaces.target().warn("faces that name vertices which are not there were skipped");
    }
  }
}

Affine moved(const glm::dvec3& by) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, by}; }

void add_insert(const DxfRecord& entity, const DxfStyle& style, DxfSurfaces& surfaces) {
  DxfInsert insert;
  insert.block = dxf_lower_case(entity.text(2));
  insert.style = style;
  const double angle = glm::radians(entity.number(50));
  // Right angles are exact.
  const double turns = entity.number(50) / 90;
  const bool right = turns == std::floor(turns) && std::abs(turns) < 1e6;
  const auto quarter = right ? ((static_cast<int64_t>(turns) % 4) + 4) % 4 : 0;
  static constexpr std::array<double, 4> sines = {0, 1, 0, -1}, cosines = {1, 0, -1, 0};
  const double s = right ? sines[static_cast<size_t>(quarter)] : std::sin(angle);
  const double c = right ? cosines[static_cast<size_t>(quarter)] : std::cos(angle);
  const Affine turn({c, s, 0}, {-s, c, 0}, {0, 0, 1}, glm::dvec3(0));
  glm::dvec3 scale;
  for (int i = 0; i < 3; ++i) {
    scale[i] = entity.number(41 + i, 1);
    if (scale[i] == 0) scale[i] = 1;  // as AutoCAD does
  }
  const Affine scaling({scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z}, glm::dvec3(0));
  const Affine axes = dxf_object_axes(entity);
  const Affine placed = axes * glm::dmat4(moved(corner(entity, 0))) * glm::dmat4(turn);
  insert.transform = placed * glm::dmat4(scaling);
  insert.column = placed * glm::dvec4(entity.number(44), 0, 0, 0);
  insert.row = placed * glm::dvec4(0, entity.number(45), 0, 0);
  insert.columns = static_cast<uint32_t>(std::clamp<int64_t>(entity.integer(70, 1), 1, 1 << 20));
  insert.rows = static_cast<uint32_t>(std::clamp<int64_t>(entity.integer(71, 1), 1, 1 << 20));
  insert.handle = entity.text(5);
  surfaces.block().inserts.push_back(std::move(insert));
}

bool is_one_of(std::string_view type, std::initializer_list<std::string_view> types) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

/// Counts an entity that is not drawn, with its kind and why.
void count_skipped(const std::string& type, FileImport& target) {
  const std::string kind = one_line(type.substr(0, 24));
  if (is_one_of(type, {"LINE", "LWPOLYLINE", "POLYLINE", "CIRCLE", "ARC", "ELLIPSE", "SPLINE", "POINT", "RAY",
                       "XLINE", "HELIX"})) {
    target.warn(fmt::format("{} entities hold no surface and were skipped", kind));
  } else if (is_one_of(type, {"3DSOLID", "BODY", "REGION", "SURFACE", "EXTRUDEDSURFACE", "LOFTEDSURFACE",
                              "PLANESURFACE", "REVOLVEDSURFACE", "SWEPTSURFACE", "NURBSURFACE"})) {
    target.warn(
        fmt::format("{} entities (ACIS, which only AutoCAD's own programs read) were skipped; convert "
                    "them to meshes, or export the drawing as STL or FBX",
                    kind));
  } else if (is_one_of(type, {"TEXT", "MTEXT", "ATTRIB", "ATTDEF", "DIMENSION", "LEADER", "MULTILEADER",
                              "TOLERANCE", "VIEWPORT", "HATCH", "IMAGE", "WIPEOUT", "OLE2FRAME",
                              "ARC_DIMENSION", "ACAD_TABLE"})) {
    target.warn(fmt::format("{} entities (annotation) were skipped", kind));
  } else {
    target.warn(fmt::format("{} entities are not understood and were skipped", kind));
  }
}

}  // namespace

void add_dxf_entity(const DxfRecord& entity, std::span<const DxfRecord> vertices, DxfSurfaces& surfaces) {
  FileImport& target = surfaces.target();
  if (entity.integer(60) != 0) return target.warn("entities that the drawing hides were skipped");
  if (entity.integer(67) == 1) return target.warn("entities of paper space were skipped");
  const DxfStyle style = surfaces.style_of(entity);
  if (entity.type == "3DFACE") {
    add_3dface(entity, style, surfaces);
  } else if (entity.type == "SOLID" || entity.type == "TRACE") {
    add_solid(entity, style, surfaces);
  } else if (entity.type == "MESH") {
    add_mesh(entity, style, surfaces);
  } else if (entity.type == "INSERT") {
    add_insert(entity, style, surfaces);
  } else if (!add_dxf_polyline_mesh(entity, vertices, style, surfaces) &&
             !add_dxf_curve(entity, vertices, style, surfaces)) {
    count_skipped(entity.type, target);
  }
}

}  // namespace triptych
