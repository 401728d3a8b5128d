// PLY, ASCII and binary of both byte orders, with elements and properties of any kind around vertices and
// faces.
#include "base/error.hpp"
#include "model/import/display_color.hpp"
#include "model/import/import_file.hpp"
#include "model/import/import_ply_header.hpp"
#include "model/import/import_ply_values.hpp"
#include "model/import/mesh_spool.hpp"
#include "model/import/mesh_stream_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace triptych {

namespace {

/// Which properties of a vertex hold x, y and z.
std::array<size_t, 3> coordinates_of(const PlyElement& element, FileImport& target) {
  std::array<size_t, 3> at;
  for (size_t i = 0; i < 3; ++i) {
    static constexpr std::array names = {"x", "y", "z"};
    const auto found = element.find({names[i]});
    if (!found || element.properties[*found].count_type)
      fail(target.place(), "element \"vertex\" has no property \"{}\"", names[i]);
    at[i] = *found;
  }
  if (element.count > std::numeric_limits<uint32_t>::max())
    fail(target.place(), "more vertices than 32 bits can index");
  return at;
}

/// Which properties of a vertex or face hold red, green and blue, if it has them.
std::optional<std::array<size_t, 3>> channels_of(const PlyElement& element) {
  const std::array found = {element.find({"red", "diffuse_red", "r"}),
                            element.find({"green", "diffuse_green", "g"}),
                            element.find({"blue", "diffuse_blue", "b"})};
  std::array<size_t, 3> at;
  for (size_t i = 0; i < 3; ++i) {
    if (!found[i] || element.properties[*found[i]].count_type) return std::nullopt;
    at[i] = *found[i];
  }
  return at;
}

/// Which properties of a vertex hold its normal, if it has one.
std::optional<std::array<size_t, 3>> normals_of(const PlyElement& element) {
  std::array<size_t, 3> at;
  for (size_t i = 0; i < 3; ++i) {
    static constexpr std::array names = {"nx", "ny", "nz"};
    const auto found = element.find({names[i]});
    if (!found || element.properties[*found].count_type) return std::nullopt;
    at[i] = *found;
  }
  return at;
}

/// What a channel's value is multiplied by to be from 0 to 1: whole numbers go to 255, whatever their type,
/// but for the one of 16 bits.
double channel_scale(PlyType type) {
  if (type == PlyType::float32 || type == PlyType::float64) return 1;
  return 1.0 / (type == PlyType::uint16 ? 65535 : 255);
}

size_t corner_list_of(const PlyElement& element, uint64_t vertex_count, const FileImport& target) {
  const auto list = element.find({"vertex_indices", "vertex_index"});
  if (!list || !element.properties[*list].count_type)
    fail(target.place(), "element \"{}\" has no list \"vertex_indices\"", element.name);
  if (vertex_count == 0) fail(target.place(), "faces without vertices");
  return *list;
}

void read_vertices(const PlyElement& element, PlyValues& values, FileImport& target, MeshSpool& spool) {
  const std::array<size_t, 3> at = coordinates_of(element, target);
  const auto channels = channels_of(element), normals = normals_of(element);
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin_record();
    glm::dvec3 position{0}, color{0}, normal{0};
    for (size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (property.count_type) {
        values.skip(property);
        continue;
      }
      const double value = values.read(property.type);
      for (int axis = 0; axis < 3; ++axis) {
        if (k == at[static_cast<size_t>(axis)]) position[axis] = value;
        if (channels && k == (*channels)[static_cast<size_t>(axis)])
          color[axis] = value * channel_scale(property.type);
        if (normals && k == (*normals)[static_cast<size_t>(axis)]) normal[axis] = value;
      }
    }
    spool.add_vertex(position, channels ? std::optional(color) : std::nullopt, normal);
  }
}

/// Colours of faces, where vertices have none.
std::optional<FaceColors> face_colors_of(const PlyHeader& header) {
  std::optional<FaceColors> colors;
  for (const PlyElement& element : header.elements) {
    const auto channels = channels_of(element);
    if (element.name == "vertex" && channels) return std::nullopt;
    if (element.name != "face" || !channels) continue;
    colors.emplace(FaceColors{.properties = *channels});
    for (int i = 0; i < 3; ++i)
      colors->scale[i] = channel_scale(element.properties[(*channels)[static_cast<size_t>(i)]].type);
  }
  return colors;
}

void read_faces(const PlyElement& element, uint64_t vertex_count, const std::optional<FaceColors>& colors,
                PlyValues& values, FileImport& target, MeshSpool& spool) {
  if (element.count == 0) return;
  const size_t list = corner_list_of(element, vertex_count, target);
  std::vector<uint32_t> corners;
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin_record();
    glm::dvec3 color{0};
    for (size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      const auto channel = colors ? std::find(colors->properties.begin(), colors->properties.end(), k) -
                                        colors->properties.begin()
                                  : 3;
      if (k == list) {
        corners.resize(values.read_length(property));
        for (uint32_t& corner : corners)
          corner =
              static_cast<uint32_t>(values.read_index(property.type, vertex_count - 1, "a face's vertex"));
      } else if (channel < 3) {
        const auto axis = static_cast<int>(channel);
        color[axis] = values.read(property.type) * colors->scale[axis];
      } else {
        values.skip(property);
      }
    }
    spool.add_face(corners, 0, colors ? vertex_color(color) : VertexColor{});
  }
}

/// Adds the triangles between the corners from `begin` on: every second one turns the other way.
void add_strip(std::span<const uint32_t> strip, MeshSpool& spool) {
  for (size_t i = 2; i < strip.size(); ++i) {
    const uint32_t a = strip[i - 2], b = strip[i - 1], c = strip[i];
    if (a == b || b == c || c == a) continue;  // joins two strips
    spool.add_face(i % 2 == 0 ? std::array{a, b, c} : std::array{b, a, c}, 0);
  }
}

/// Lists of strips, each of which ends with −1 or with its list.
void read_strips(const PlyElement& element, uint64_t vertex_count, PlyValues& values, FileImport& target,
                 MeshSpool& spool) {
  if (element.count == 0) return;
  const size_t list = corner_list_of(element, vertex_count, target);
  std::vector<uint32_t> strip;
  const auto read_list = [&](const PlyProperty& property) {
    strip.clear();
    for (uint64_t left = values.read_length(property); left > 0; --left) {
      const auto vertex = values.read_vertex_or_end(property.type, vertex_count);
      if (vertex) {
        strip.push_back(*vertex);
        continue;
      }
      add_strip(strip, spool);
      strip.clear();
    }
    add_strip(strip, spool);
  };
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin_record();
    for (size_t k = 0; k < element.properties.size(); ++k) {
      if (k == list) {
        read_list(element.properties[k]);
      } else {
        values.skip(element.properties[k]);
      }
    }
  }
}

/// The properties `at` of all vertices.
PositionTable table_of(const PlyElement& element, const std::array<size_t, 3>& at) {
  PositionTable table{.source = nullptr, .fields = {}};
  for (size_t k = 0; k < element.properties.size(); ++k) {
    for (size_t axis = 0; axis < 3; ++axis) {
      if (k == at[axis]) table.fields[axis] = {table.stride, element.properties[k].type};
    }
    table.stride += scalar_bytes(element.properties[k].type);
  }
  table.count = element.count;
  return table;
}

/// Whether the file can be read in place: binary vertices of one length, whose offset is known, and faces
/// whose offset is known.
bool can_stream(const PlyHeader& header) {
  if (header.encoding == PlyEncoding::ascii) return false;
  bool offset_known = true, faces = false;
  for (const PlyElement& element : header.elements) {
    const auto record = element.record_bytes();
    if (element.name == "vertex" && (!record || !offset_known || *record > PositionTable::max_stride))
      return false;
    if (element.name == "tristrips" && element.count > 0) return false;
    if (element.name == "face" && !offset_known) return false;
    faces = faces || element.name == "face";
    offset_known = offset_known && record;
  }
  return faces;
}

void add_stream(const PlyHeader& header, uint64_t offset, uint64_t vertex_count, FileImport& target) {
  const auto source = target.content();
  PositionTable vertices;
  std::optional<ColorTable> colors;
  std::optional<PositionTable> normals;
  FaceTable faces{.source = source, .element = {}, .material = {}, .end = source->size()};
  for (const PlyElement& element : header.elements) {
    const auto record = element.record_bytes();
    if (element.name == "vertex") {
      vertices = table_of(element, coordinates_of(element, target));
      vertices.offset = offset;
      if (const auto channels = channels_of(element)) {
        colors.emplace(ColorTable{.values = table_of(element, *channels)});
        colors->values.offset = offset;
        for (int i = 0; i < 3; ++i)
          colors->scale[i] = channel_scale(element.properties[(*channels)[static_cast<size_t>(i)]].type);
      }
      if (const auto at = normals_of(element)) {
        normals = table_of(element, *at);
        normals->offset = offset;
      }
    } else if (element.name == "face") {
      faces.element = element;
      faces.begin = offset;
      faces.end_known = true;
      faces.colors = face_colors_of(header);
    } else {
      target.warn(fmt::format("records of the element \"{}\" were skipped", element.name), element.count);
      faces.end_known = faces.end_known && record;
      if (faces.end_known) faces.end -= *record * element.count;
    }
    if (record) offset += *record * element.count;
  }
  faces.list = corner_list_of(faces.element, vertex_count, target);
  vertices.source = source;
  vertices.swapped = faces.swapped = header.encoding == PlyEncoding::big_endian;
  vertices.check();
  if (colors) {
    colors->values.source = source;
    colors->values.swapped = vertices.swapped;
  }
  if (normals) {
    normals->source = source;
    normals->swapped = vertices.swapped;
  }
  const auto stream = std::make_shared<FaceStream>(std::move(vertices), std::move(faces), std::move(colors),
                                                   std::move(normals));
  target.add_instance(target.add_stream(target.file().stem().string(), stream), Affine(1));
}

/// Whether the colours of this element are drawn.
bool uses_colors(const PlyHeader& header, const PlyElement& element) {
  return element.name == "vertex" ? channels_of(element).has_value()
                                  : element.name == "face" && face_colors_of(header);
}

/// Warns of confidences and other properties that the model does not have.
void warn_of_unused(const PlyHeader& header, FileImport& target) {
  static constexpr std::array used = {"x", "y", "z", "vertex_indices", "vertex_index"};
  static constexpr std::array colours = {"red",           "green",        "blue", "alpha", "diffuse_red",
                                         "diffuse_green", "diffuse_blue", "r",    "g",     "b"};
  static constexpr std::array directions = {"nx", "ny", "nz"};
  for (const PlyElement& element : header.elements) {
    if (element.name != "vertex" && element.name != "face" && element.name != "tristrips") continue;
    std::string names;
    for (const PlyProperty& property : element.properties) {
      const bool known =
          std::count(used.begin(), used.end(), property.name) > 0 ||
          (uses_colors(header, element) && std::count(colours.begin(), colours.end(), property.name) > 0) ||
          (element.name == "vertex" && normals_of(element) &&
           std::count(directions.begin(), directions.end(), property.name) > 0);
      if (!known && names.size() < 120) names += " " + property.name.substr(0, 40);
    }
    if (!names.empty())
      target.remark(fmt::format("properties of \"{}\" are not used:{}", element.name, names));
  }
}

uint64_t count_of(const PlyHeader& header, const std::string& name, const FileImport& target) {
  uint64_t count = 0;
  int found = 0;
  for (const PlyElement& element : header.elements) {
    if (element.name != name) continue;
    count = element.count;
    ++found;
  }
  if (found > 1) fail(target.place(), "has several elements \"{}\"", name);
  return count;
}

}  // namespace

void import_ply(FileImport& target) {
  ImportReader reader(target.content());
  const PlyHeader header = read_ply_header(reader);
  const uint64_t vertex_count = count_of(header, "vertex", target);
  const uint64_t face_count = count_of(header, "face", target);
  if (face_count == 0 && count_of(header, "tristrips", target) == 0)
    fail(target.place(), "holds no triangles: {} points, which are not drawn", vertex_count);
  target.warn("statements of the header are not understood and were skipped", header.unknown_statements);
  warn_of_unused(header, target);
  if (can_stream(header) && target.should_stream(face_count))
    return add_stream(header, reader.offset(), vertex_count, target);
  PlyValues values(reader, header.encoding, target.place());
  MeshSpool spool(target);
  spool.begin_mesh(target.file().stem().string());
  const auto face_colors = face_colors_of(header);
  if (face_colors) spool.color_faces();
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(element, values, target, spool);
    } else if (element.name == "face") {
      read_faces(element, vertex_count, face_colors, values, target, spool);
    } else if (element.name == "tristrips") {
      read_strips(element, vertex_count, values, target, spool);
    } else {
      target.warn(fmt::format("records of the element \"{}\" were skipped", element.name), element.count);
      for (uint64_t i = 0; i < element.count; ++i) {
        values.begin_record();
        for (const PlyProperty& property : element.properties) values.skip(property);
      }
    }
  }
  values.finish(target);
  spool.finish();
}

}  // namespace triptych
