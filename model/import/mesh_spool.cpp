#include "model/import/mesh_spool.hpp"

#include "base/error.hpp"
#include "model/import/display_color.hpp"
#include "model/import/mesh_stream_faces.hpp"
#include "model/import/triangulate.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace triptych {

namespace {
constexpr uint64_t max_in_memory = uint64_t{1} << 18;

PositionTable table_of_floats(std::shared_ptr<const StreamSource> source, uint64_t count) {
  return {.source = std::move(source),
          .count = count,
          .stride = sizeof(glm::vec3),
          .fields = {{{0, ScalarType::float32}, {4, ScalarType::float32}, {8, ScalarType::float32}}}};
}
}  // namespace

/// Before the vertex is added.
void MeshSpool::add_color(const std::optional<glm::dvec3>& color) {
  constexpr float no_number = std::numeric_limits<float>::quiet_NaN();
  constexpr glm::vec3 none(no_number);
  if (colors_.size() == 0) {
    if (!color) return;
    if (in_file_) colors_.move_to_file(target_.options().temporary_folder);
    for (uint64_t i = 0; i < vertex_count(); ++i) colors_.append(std::as_bytes(std::span(&none, 1)));
  }
  const glm::vec3 stored = color ? glm::vec3(*color) : none;
  colors_.append(std::as_bytes(std::span(&stored, 1)));
}

/// Before the vertex is added.
void MeshSpool::add_normal(const glm::dvec3& normal) {
  constexpr glm::vec3 none(0);
  if (normals_.size() == 0) {
    if (normal == glm::dvec3(0)) return;
    if (in_file_) normals_.move_to_file(target_.options().temporary_folder);
    for (uint64_t i = 0; i < vertex_count(); ++i) normals_.append(std::as_bytes(std::span(&none, 1)));
  }
  const glm::vec3 stored(normal);
  normals_.append(std::as_bytes(std::span(&stored, 1)));
}

void MeshSpool::add_vertex(const glm::dvec3& position, const std::optional<glm::dvec3>& color,
                           const glm::dvec3& normal) {
  if (vertex_count() == std::numeric_limits<uint32_t>::max())
    fail(target_.place(), "more vertices than 32 bits can index");
  add_color(color);
  add_normal(normal);
  vertices_.append(std::as_bytes(std::span(&position, 1)));
  grow_beyond(vertex_count());
}

void MeshSpool::begin_mesh(std::string name) {
  if (parts_.empty() || parts_.back().faces > 0) parts_.push_back({{}, faces_.size()});
  parts_.back().name = std::move(name);
  parts_.back().object = parts_.back().group = no_id;
}

void MeshSpool::begin_object(std::string name) {
  object_ = no_id;
  if (!name.empty()) {
    object_ = static_cast<uint32_t>(names_.size());
    names_.push_back({name});
  }
  begin_mesh(std::move(name));
  parts_.back().object = object_;
}

void MeshSpool::begin_group(std::string name) {
  uint32_t group = no_id;
  if (!name.empty()) {
    const auto [found, added] =
        groups_.try_emplace(std::pair(object_, name), static_cast<uint32_t>(names_.size()));
    group = found->second;
    if (added) names_.push_back({name, object_});
  }
  begin_mesh(std::move(name));
  parts_.back().object = object_, parts_.back().group = group;
}

SourceObjectId MeshSpool::object_of(uint32_t name) {
  if (name == no_id) return no_id;
  Name& named = names_[name];
  if (named.id == no_id) named.id = target_.objects().add({.name = named.name}, object_of(named.within));
  return named.id;
}

void MeshSpool::add_face(std::span<const uint32_t> corners, uint32_t material, const VertexColor& color,
                         std::span<const VertexNormal> normals, std::span<const TextureCoordinates> places) {
  if (corners.size() < 3) return target_.warn("faces with fewer than three corners were skipped");
  if (parts_.empty()) begin_mesh("");
  const auto count = static_cast<uint32_t>(corners.size());
  faces_.append(std::as_bytes(std::span(&material, 1)));
  if (faces_have_colors_) faces_.append(std::as_bytes(std::span(color)));
  if (faces_have_normals_) {
    const auto shaded = static_cast<uint32_t>(normals.size());
    faces_.append(std::as_bytes(std::span(&shaded, 1)));
    faces_.append(std::as_bytes(normals));
  }
  if (faces_have_places_) {
    const auto placed = static_cast<uint32_t>(places.size());
    faces_.append(std::as_bytes(std::span(&placed, 1)));
    faces_.append(std::as_bytes(places));
  }
  faces_.append(std::as_bytes(std::span(&count, 1)));
  faces_.append(std::as_bytes(corners));
  ++parts_.back().faces;
  parts_.back().end = faces_.size();
  triangles_ += corners.size() - 2;
  grow_beyond(triangles_);
}

void MeshSpool::grow_beyond(uint64_t triangles_or_vertices) {
  if (in_file_ || triangles_or_vertices <= std::min(max_in_memory, target_.memory_left())) return;
  in_file_ = true;
  vertices_.move_to_file(target_.options().temporary_folder);
  if (colors_.size() > 0) colors_.move_to_file(target_.options().temporary_folder);
  if (normals_.size() > 0) normals_.move_to_file(target_.options().temporary_folder);
  faces_.move_to_file(target_.options().temporary_folder);
}

void MeshSpool::finish() {
  if (!parts_.empty() && parts_.back().faces == 0) parts_.pop_back();
  if (in_file_) {
    place_streams();
  } else {
    place_in_memory();
  }
}

void MeshSpool::take_face(std::span<const std::byte>& bytes, Face& face) const {
  const auto take = [&](void* into, size_t size) {
    if (size > 0) std::memcpy(into, bytes.data(), size);
    bytes = bytes.subspan(size);
  };
  uint32_t count = 0;
  take(&face.material, sizeof(face.material));
  if (faces_have_colors_) take(face.color.data(), face.color.size());
  if (faces_have_normals_) take(&count, sizeof(count));
  face.normals.resize(count);
  take(face.normals.data(), count * sizeof(VertexNormal));
  count = 0;
  if (faces_have_places_) take(&count, sizeof(count));
  face.places.resize(count);
  take(face.places.data(), count * sizeof(TextureCoordinates));
  take(&count, sizeof(count));
  face.corners.resize(count);
  take(face.corners.data(), count * sizeof(uint32_t));
}

/// Adds the meshes to the model, each with the vertices that it uses, and where faces or their corners have
/// colours or normals, once for each that comes after another.
void MeshSpool::place_in_memory() {
  std::vector<glm::dvec3> positions(vertex_count()), corners;
  if (!positions.empty()) std::memcpy(positions.data(), vertices_.bytes().data(), vertices_.bytes().size());
  std::vector<glm::vec3> colors(colors_.size() / sizeof(glm::vec3));
  if (!colors.empty()) std::memcpy(colors.data(), colors_.bytes().data(), colors_.bytes().size());
  std::vector<glm::vec3> normals(normals_.size() / sizeof(glm::vec3));
  if (!normals.empty()) std::memcpy(normals.data(), normals_.bytes().data(), normals_.bytes().size());
  std::vector<uint32_t> local(positions.size()), owner(positions.size(), 0);
  Face face;
  const bool shaded = faces_have_normals_ || !normals.empty();
  std::vector<std::array<uint32_t, 3>> cut;
  uint32_t number = 0;
  for (Part& part : parts_) {
    ++number;
    Mesh mesh{.name = std::move(part.name), .positions = {}, .triangles = {}};
    for (auto bytes = faces_.bytes().subspan(part.begin, part.end - part.begin); !bytes.empty();) {
      take_face(bytes, face);
      corners.clear();
      for (size_t k = 0; k < face.corners.size(); ++k) {
        uint32_t& vertex = face.corners[k];
        const VertexNormal normal = k < face.normals.size() ? face.normals[k]
                                    : normals.empty()       ? VertexNormal{}
                                                            : to_vertex_normal(glm::dvec3(normals[vertex]));
        const TextureCoordinates place = k < face.places.size() ? face.places[k] : TextureCoordinates{};
        corners.push_back(positions[vertex]);
        const bool known = owner[vertex] == number &&
                           (!faces_have_colors_ || mesh.colors[local[vertex]] == face.color) &&
                           (!shaded || mesh.normals[local[vertex]] == normal) &&
                           (!faces_have_places_ || mesh.coordinates[local[vertex]] == place);
        if (!known) {
          owner[vertex] = number;
          local[vertex] = static_cast<uint32_t>(mesh.positions.size());
          mesh.positions.push_back(positions[vertex]);
          if (shaded) mesh.normals.push_back(normal);
          if (faces_have_places_) mesh.coordinates.push_back(place);
          if (faces_have_colors_) {
            mesh.colors.push_back(face.color);
          } else if (!colors.empty()) {
            mesh.colors.push_back(vertex_color(color_scale_ * glm::dvec3(colors[vertex])));
          }
        }
        vertex = local[vertex];
      }
      triangulate(corners, cut);
      target_.warn(fan_warning, corners.size() > max_clipped_corners);
      for (const auto& [a, b, c] : cut)
        mesh.triangles.push_back({{face.corners[a], face.corners[b], face.corners[c]}, face.material});
    }
    if (std::none_of(mesh.normals.begin(), mesh.normals.end(), has_normal)) mesh.normals.clear();
    if (std::none_of(mesh.colors.begin(), mesh.colors.end(), is_colored)) mesh.colors.clear();
    if (std::none_of(mesh.coordinates.begin(), mesh.coordinates.end(), is_on_texture))
      mesh.coordinates.clear();
    if (const auto added = target_.add_mesh(std::move(mesh)))
      target_.add_instance(*added, Affine(1), object_of(part));
  }
}

void MeshSpool::place_streams() {
  const PositionTable vertices{
      .source = vertices_.take_file(target_.place()),
      .count = vertex_count(),
      .stride = sizeof(glm::dvec3),
      .fields = {{{0, ScalarType::float64}, {8, ScalarType::float64}, {16, ScalarType::float64}}}};
  std::optional<ColorTable> colors;
  if (colors_.size() > 0) {
    colors.emplace();
    colors->scale = glm::dvec3(color_scale_);
    colors->values = table_of_floats(colors_.take_file(target_.place()), vertices.count);
  }
  std::optional<PositionTable> normals;
  if (normals_.size() > 0) normals = table_of_floats(normals_.take_file(target_.place()), vertices.count);
  const auto faces = faces_.take_file(target_.place());
  std::vector<PlyProperty> properties = {{"material", ScalarType::uint32, std::nullopt}};
  std::optional<FaceColors> face_colors;
  if (faces_have_colors_) {
    for (const char* channel : {"red", "green", "blue", "alpha"})
      properties.push_back({channel, ScalarType::uint8, std::nullopt});
    face_colors.emplace(FaceColors{.properties = {1, 2, 3}, .scale = glm::dvec3(1 / 255.0)});
  }
  std::optional<size_t> face_normals;
  if (faces_have_normals_) {
    face_normals = properties.size();
    properties.push_back({"normals", ScalarType::uint32, ScalarType::uint32});
  }
  std::optional<size_t> face_places;
  if (faces_have_places_) {
    face_places = properties.size();
    properties.push_back({"places", ScalarType::float64, ScalarType::uint32});  // by its length
  }
  properties.push_back({"corners", ScalarType::uint32, ScalarType::uint32});
  for (Part& part : parts_) {
    FaceTable table{.source = faces,
                    .element = {"face", part.faces, properties},
                    .list = properties.size() - 1,
                    .material = 0,
                    .colors = face_colors,
                    .normals = face_normals,
                    .places = face_places,
                    .begin = part.begin,
                    .end = part.end,
                    .end_known = true};
    const auto stream = std::make_shared<FaceStream>(vertices, std::move(table), colors, normals);
    target_.add_instance(target_.add_stream(std::move(part.name), stream), Affine(1), object_of(part));
  }
}

}  // namespace triptych
