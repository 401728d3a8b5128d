// PLY, ASCII and binary of both byte orders, with elements and properties of any kind around vertices and
// faces.
#include "base/error.hpp"
#include "scene/import_file.hpp"
#include "scene/import_ply_header.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace triptych {

namespace {

template <typename Value>
double read_as(ImportReader& reader, bool swap) {
  auto bytes = reader.read(sizeof(Value));
  std::array<std::byte, sizeof(Value)> copy;
  std::copy(bytes.begin(), bytes.end(), copy.begin());
  if (swap) std::reverse(copy.begin(), copy.end());
  Value value;
  std::memcpy(&value, copy.data(), sizeof(value));
  return static_cast<double>(value);
}

/// Reads the values of records one after the other, whichever way they are written. Every type fits a double
/// exactly.
class PlyValues {
 public:
  PlyValues(ImportReader& reader, PlyEncoding encoding, std::string name)
      : reader_(reader), encoding_(encoding), name_(std::move(name)) {}

  /// In ASCII each record has its own line; empty lines are passed over.
  void begin_record() {
    if (encoding_ != PlyEncoding::ascii) return;
    while (trimmed(line_).empty()) {
      if (!reader_.next_line(line_)) fail(place(), "the file ends too soon");
    }
  }

  void end_record() {
    if (encoding_ != PlyEncoding::ascii) return;
    if (!trimmed(line_).empty()) fail(place(), "more values than the element has properties");
    line_ = {};
  }

  double read(PlyType type) {
    if (encoding_ == PlyEncoding::ascii) {
      const auto number = to_number(take_word(line_));
      if (!number) fail(place(), "a number is missing");
      return *number;
    }
    const bool swap = encoding_ == PlyEncoding::big_endian;
    switch (type) {
      case PlyType::int8:
        return read_as<int8_t>(reader_, swap);
      case PlyType::uint8:
        return read_as<uint8_t>(reader_, swap);
      case PlyType::int16:
        return read_as<int16_t>(reader_, swap);
      case PlyType::uint16:
        return read_as<uint16_t>(reader_, swap);
      case PlyType::int32:
        return read_as<int32_t>(reader_, swap);
      case PlyType::uint32:
        return read_as<uint32_t>(reader_, swap);
      case PlyType::float32:
        return read_as<float>(reader_, swap);
      case PlyType::float64:
        return read_as<double>(reader_, swap);
    }
    fail(place(), "a value of an unknown type");
  }

  /// A whole number from 0 to `limit`; anything else is an Error.
  uint64_t read_index(PlyType type, uint64_t limit, const char* what) {
    const double value = read(type);
    if (!(value >= 0 && value <= static_cast<double>(limit)) || value != std::floor(value)) {
      fail(place(), "{} is {}, and must be from 0 to {}", what, value, limit);
    }
    return static_cast<uint64_t>(value);
  }

  /// The length of a list, checked against what the file can still hold.
  uint64_t read_length(const PlyProperty& property) {
    const uint64_t smallest = encoding_ == PlyEncoding::ascii ? 1 : ply_size(property.type);
    const uint64_t left = encoding_ == PlyEncoding::ascii ? line_.size() : reader_.left();
    return read_index(*property.count_type, left / smallest, "a list's length");
  }

  void skip(const PlyProperty& property) {
    const uint64_t count = property.count_type ? read_length(property) : 1;
    for (uint64_t i = 0; i < count; ++i) read(property.type);
  }

  std::string place() const {
    return encoding_ == PlyEncoding::ascii ? reader_.line_place()
                                           : fmt::format("{}: byte {}", name_, reader_.offset());
  }

 private:
  ImportReader& reader_;
  PlyEncoding encoding_;
  std::string name_;
  std::string_view line_;
};

void read_vertices(const PlyElement& element, PlyValues& values, FileImport& target, Mesh& mesh) {
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
  if (element.find({"red", "green", "blue", "diffuse_red", "r"})) {
    target.warn("vertices with a colour, which is not drawn yet", element.count);
  }
  mesh.positions.reserve(element.count);
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin_record();
    glm::dvec3 position{0};
    for (size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (property.count_type) {
        values.skip(property);
        continue;
      }
      const double value = values.read(property.type);
      for (int axis = 0; axis < 3; ++axis) {
        if (k == at[static_cast<size_t>(axis)]) position[axis] = value;
      }
    }
    values.end_record();
    mesh.positions.push_back(position);
  }
}

void read_faces(const PlyElement& element, uint64_t vertex_count, PlyValues& values, FileImport& target,
                Mesh& mesh) {
  const auto list = element.find({"vertex_indices", "vertex_index"});
  if (element.count == 0) return;
  if (!list || !element.properties[*list].count_type)
    fail(target.place(), "element \"face\" has no list \"vertex_indices\"");
  if (vertex_count == 0) fail(target.place(), "faces without vertices");
  std::vector<uint32_t> corners;
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin_record();
    for (size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (k != *list) {
        values.skip(property);
        continue;
      }
      corners.resize(values.read_length(property));
      for (uint32_t& corner : corners) {
        corner = static_cast<uint32_t>(values.read_index(property.type, vertex_count - 1, "a face's vertex"));
      }
    }
    values.end_record();
    if (corners.size() < 3) target.warn("faces with fewer than three corners were skipped");
    for (size_t k = 2; k < corners.size(); ++k)
      mesh.triangles.push_back({{corners[0], corners[k - 1], corners[k]}, 0});
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
  ImportReader reader(target.file());
  const PlyHeader header = read_ply_header(reader);
  if (count_of(header, "tristrips", target) > 0)
    fail(target.place(), "holds triangle strips, which are not supported");
  const uint64_t vertex_count = count_of(header, "vertex", target);
  if (count_of(header, "face", target) == 0) fail(target.place(), "holds no triangles");
  PlyValues values(reader, header.encoding, target.place());
  Mesh mesh{.name = target.file().stem().string(), .positions = {}, .triangles = {}};
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(element, values, target, mesh);
    } else if (element.name == "face") {
      read_faces(element, vertex_count, values, target, mesh);
    } else {
      target.warn(fmt::format("records of the element \"{}\" were skipped", element.name), element.count);
      for (uint64_t i = 0; i < element.count; ++i) {
        values.begin_record();
        for (const PlyProperty& property : element.properties) values.skip(property);
        values.end_record();
      }
    }
  }
  if (header.encoding != PlyEncoding::ascii)
    target.warn("bytes after the last element were skipped", reader.left());
  if (const auto added = target.add_mesh(std::move(mesh))) target.add_instance(*added, Affine(1));
}

}  // namespace triptych
