#include "model/import/mesh_stream_faces.hpp"

#include "model/import/display_color.hpp"
#include "model/import/mesh_stream_batch.hpp"
#include "model/import/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace triptych {

namespace {

/// The number of triangles by the length of the file, if that is known: a face of n corners is n − 2
/// triangles.
uint64_t promised_triangles(const FaceTable& faces) {
  uint64_t fixed = 0;
  for (size_t k = 0; k < faces.element.properties.size(); ++k) {
    const PlyProperty& property = faces.element.properties[k];
    if (property.count_type && k != faces.list) return faces.element.count;
    fixed += scalar_bytes(property.count_type.value_or(property.type));
  }
  const uint64_t item = scalar_bytes(faces.element.properties[faces.list].type);
  const uint64_t count = faces.element.count;
  if (!faces.end_known || count > (faces.end - faces.begin) / (fixed + item)) return count;
  const uint64_t items = (faces.end - faces.begin - count * fixed) / item;
  return std::max(count, items - std::min(items, 2 * count));
}

struct Vertex {
  glm::dvec3 position{0};
  VertexColor color{};
  VertexNormal normal{};
  TextureCoordinates place{};
};

class VertexCache {
 public:
  VertexCache(const PositionTable& positions, const std::optional<ColorTable>& colors,
              const std::optional<PositionTable>& normals)
      : positions_(positions) {
    if (colors) colors_.emplace(*colors);
    if (normals) normals_.emplace(*normals);
  }
  uint64_t count() const { return positions_.count(); }
  Vertex at(uint64_t index) {
    return {positions_.at(index),
            colors_ ? colors_->at(index) : VertexColor{},
            normals_ ? normals_->at(index) : VertexNormal{},
            {}};
  }

 private:
  PositionCache positions_;
  std::optional<ColorCache> colors_;
  std::optional<NormalCache> normals_;
};

uint64_t read_length(SourceWindow& window, const PlyProperty& property, bool swapped) {
  const std::byte* bytes = window.take(scalar_bytes(*property.count_type));
  const double length = *property.count_type == ScalarType::uint8
                            ? std::to_integer<uint8_t>(*bytes)
                            : load_scalar(bytes, *property.count_type, swapped);
  const uint64_t most = window.left() / scalar_bytes(property.type);
  if (!(length >= 0)) fail(window.place(), "a list's length is {}", length);
  if (length > static_cast<double>(most))
    fail(window.place(), "the file ends within a list of {} values", length);
  return static_cast<uint64_t>(length);
}

/// Reads the colours of faces one after the other. They mostly stand behind the corners, which so need not be
/// kept until then.
class FaceColorReader {
 public:
  explicit FaceColorReader(const FaceTable& faces)
      : faces_(faces), window_(faces.source, faces.begin, faces.end) {}

  VertexColor next() {
    const auto& properties = faces_.element.properties;
    glm::dvec3 color{0};
    for (size_t k = 0; k < properties.size(); ++k) {
      const PlyProperty& property = properties[k];
      if (property.count_type) {
        window_.skip(read_length(window_, property, faces_.swapped) * scalar_bytes(property.type));
        continue;
      }
      const std::byte* bytes = window_.take(scalar_bytes(property.type));
      for (int i = 0; i < 3; ++i) {
        if (k == faces_.colors->properties[static_cast<size_t>(i)])
          color[i] = load_scalar(bytes, property.type, faces_.swapped) * faces_.colors->scale[i];
      }
    }
    return vertex_color(color);
  }

 private:
  const FaceTable& faces_;
  SourceWindow window_;
};

/// Reads the faces one after the other.
class FaceReader {
 public:
  FaceReader(const PositionTable& vertices, const FaceTable& faces, const std::optional<ColorTable>& colors,
             const std::optional<PositionTable>& normals, TriangleBatch& batch)
      : faces_(faces),
        vertices_(vertices, colors, normals),
        window_(faces.source, faces.begin, faces.end),
        batch_(batch),
        type_(faces.element.properties[faces.list].type) {
    if (faces.colors) face_colors_.emplace(faces);
  }

  void run() {
    const auto& properties = faces_.element.properties;
    for (uint64_t i = 0; i < faces_.element.count; ++i) {
      if (face_colors_) face_color_ = face_colors_->next();
      for (size_t k = 0; k < properties.size(); ++k) {
        if (!properties[k].count_type) {
          const std::byte* bytes = window_.take(scalar_bytes(properties[k].type));
          if (k == faces_.material) std::memcpy(&material_, bytes, sizeof(material_));
        } else if (k == faces_.normals) {
          read_values(read_length(window_, properties[k], faces_.swapped), face_normals_);
        } else if (k == faces_.places) {
          read_values(read_length(window_, properties[k], faces_.swapped), face_places_);
        } else if (k == faces_.list) {
          read_corners(read_length(window_, properties[k], faces_.swapped));
        } else {
          window_.skip(read_length(window_, properties[k], faces_.swapped) *
                       scalar_bytes(properties[k].type));
        }
      }
    }
  }

  uint64_t skipped() const { return skipped_; }
  uint64_t fans() const { return fans_; }
  uint64_t left() const { return window_.left(); }

 private:
  uint32_t vertex(const std::byte* bytes) {
    if (type_ == ScalarType::int32 || type_ == ScalarType::uint32) {
      uint32_t index = 0;  // a negative one becomes larger than 2^31; the error below shows it with its sign
      std::memcpy(&index, bytes, sizeof(index));
      if (faces_.swapped) index = __builtin_bswap32(index);
      if (index < vertices_.count() && (type_ == ScalarType::uint32 || index < uint32_t{1} << 31))
        return index;
    }
    const double value = load_scalar(bytes, type_, faces_.swapped);
    if (!(value >= 0 && value < static_cast<double>(vertices_.count())) || value != std::floor(value)) {
      fail(window_.place(), "a face's vertex is {}, and must be from 0 to {}", value, vertices_.count() - 1);
    }
    return static_cast<uint32_t>(value);
  }

  void add(const Vertex& a, const Vertex& b, const Vertex& c) {
    batch_.add(a.position, b.position, c.position, material_,
               face_colors_ ? CornerColors{face_color_, face_color_, face_color_}
                            : CornerColors{a.color, b.color, c.color},
               CornerNormals{a.normal, b.normal, c.normal}, CornerCoordinates{a.place, b.place, c.place});
  }

  template <typename Value>
  void read_values(uint64_t count, std::vector<Value>& values) {
    values.resize(count);
    for (Value& value : values) std::memcpy(&value, window_.take(sizeof(value)), sizeof(value));
  }
  /// Of the face's corner: its own normal and place, if the face has those.
  Vertex corner(uint64_t index, const std::byte* bytes) {
    Vertex found = vertices_.at(vertex(bytes));
    if (index < face_normals_.size()) found.normal = face_normals_[index];
    if (index < face_places_.size()) found.place = face_places_[index];
    return found;
  }

  void read_corners(uint64_t count) {
    const size_t item = scalar_bytes(type_);
    if (count > max_clipped_corners) return read_fan(count);
    const std::byte* bytes = window_.take(count * item);
    corners_.resize(count);
    for (uint64_t i = 0; i < count; ++i) corners_[i] = corner(i, bytes + i * item);
    if (count == 3) return add(corners_[0], corners_[1], corners_[2]);
    skipped_ += count < 3;
    outline_.clear();
    for (const Vertex& corner : corners_) outline_.push_back(corner.position);
    triangulate(outline_, triangles_);
    for (const auto& [a, b, c] : triangles_) add(corners_[a], corners_[b], corners_[c]);
  }

  /// Reads a face of any number of corners without keeping them.
  void read_fan(uint64_t count) {
    ++fans_;
    const size_t item = scalar_bytes(type_);
    const Vertex first = corner(0, window_.take(item));
    Vertex before = corner(1, window_.take(item));
    for (uint64_t i = 2; i < count; ++i) {
      const Vertex next = corner(i, window_.take(item));
      add(first, before, next);
      before = next;
    }
  }

  const FaceTable& faces_;
  VertexCache vertices_;
  SourceWindow window_;
  TriangleBatch& batch_;
  ScalarType type_;
  std::optional<FaceColorReader> face_colors_;
  VertexColor face_color_{};
  uint32_t material_ = 0;
  std::vector<Vertex> corners_;
  std::vector<VertexNormal> face_normals_;  ///< of the corners that come next; empty where they have none
  std::vector<TextureCoordinates> face_places_;  ///< the same
  std::vector<glm::dvec3> outline_;
  std::vector<std::array<uint32_t, 3>> triangles_;
  uint64_t skipped_ = 0, fans_ = 0;
};

}  // namespace

FaceStream::FaceStream(PositionTable vertices, FaceTable faces, std::optional<ColorTable> colors,
                       std::optional<PositionTable> normals)
    : vertices_(std::move(vertices)),
      faces_(std::move(faces)),
      colors_(std::move(colors)),
      normals_(std::move(normals)),
      triangle_count_(promised_triangles(faces_)) {}

uint64_t FaceStream::read(const TakeTriangles& take) const {
  TriangleBatch batch(take);
  FaceReader reader(vertices_, faces_, colors_, normals_, batch);
  reader.run();
  const uint64_t dropped = batch.finish();
  dropped_ = dropped;
  skipped_faces_ = reader.skipped();
  fans_ = reader.fans();
  trailing_bytes_ = faces_.end_known ? reader.left() : 0;
  return dropped;
}

std::vector<std::string> FaceStream::warnings() const {
  return counted_warnings(faces_.source->name(),
                          {{dropped_, not_finite_warning},
                           {skipped_faces_, "faces with fewer than three corners were skipped"},
                           {fans_, fan_warning},
                           {trailing_bytes_, "bytes after the last element were skipped"}});
}

}  // namespace triptych
