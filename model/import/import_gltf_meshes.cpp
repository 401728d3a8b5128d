#include "base/error.hpp"
#include "model/import/import_gltf.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace triptych {

namespace {

constexpr uint32_t unnamed = std::numeric_limits<uint32_t>::max();

void warn_of_attributes(const GltfPrimitive& primitive, FileImport& target) {
  if (primitive.has_targets) target.warn("primitives with morph targets, drawn as stored in the file");
}

}  // namespace

GltfMeshes::GltfMeshes(const GltfFile& gltf, FileImport& target)
    : gltf_(gltf), target_(target), known_(gltf.model.meshes.size()), meshes_(gltf.model.meshes.size()) {
  GltfImages images(gltf, target);
  for (const auto& material : gltf.model.materials) {
    surfaces_.push_back(read_gltf_material(gltf, material, images, target));
    materials_.push_back(target_.add_material(surfaces_.back().material));
  }
}

std::optional<uint32_t> GltfMeshes::mesh(int64_t index, const std::string& place) {
  if (index < 0 || static_cast<size_t>(index) >= meshes_.size())
    fail(place, "names mesh {} of {}", index, meshes_.size());
  const auto i = static_cast<size_t>(index);
  if (!known_[i]) {
    known_[i] = true;
    meshes_[i] = read_mesh(i);
  }
  return meshes_[i];
}

size_t GltfMeshes::unused_count() const {
  return static_cast<size_t>(std::count(known_.begin(), known_.end(), false));
}

bool GltfMeshes::has_joints(int64_t index) const {
  if (index < 0 || static_cast<size_t>(index) >= meshes_.size()) return false;
  const auto& primitives = gltf_.model.meshes[static_cast<size_t>(index)].primitives;
  return std::any_of(primitives.begin(), primitives.end(), [](const GltfPrimitive& primitive) {
    return primitive.attributes.count("JOINTS_0") > 0;
  });
}

/// The primitives that hold triangles; those that cannot be read are counted, with what is wrong with the
/// first.
std::vector<GltfMeshes::Part> GltfMeshes::read_parts(size_t index) {
  std::vector<Part> parts;
  const auto& primitives = gltf_.model.meshes[index].primitives;
  for (size_t i = 0; i < primitives.size(); ++i) {
    try {
      auto part = read_primitive(primitives[i], fmt::format("mesh {} primitive {}", index, i));
      if (part && part->triangles.triangle_count() > 0) parts.push_back(std::move(*part));
    } catch (const Error& error) {
      if (first_damage_.empty())
        first_damage_ =
            fmt::format("primitives cannot be read and were skipped, the first: {}", error.what());
      target_.warn(first_damage_);
    }
  }
  for (Part& part : parts)
    part.triangles.place = fmt::format("{}: {}", target_.place(), part.triangles.place);
  return parts;
}

std::optional<uint32_t> GltfMeshes::read_mesh(size_t index) {
  const auto& source = gltf_.model.meshes[index];
  std::vector<Part> parts = read_parts(index);
  uint64_t triangles = 0;
  bool can_stream = true;
  for (const Part& part : parts) {
    triangles += part.triangles.triangle_count();
    can_stream = can_stream && part.can_stream;
  }
  if (parts.empty()) return std::nullopt;
  if (can_stream && target_.should_stream(triangles)) {
    std::vector<IndexedStream::Part> streamed;
    for (Part& part : parts) {
      PositionTable positions = part.unpacked
                                    ? *part.unpacked
                                    : GltfAccessor(gltf_, part.positions, part.triangles.place).positions();
      streamed.push_back({std::move(part.triangles), std::move(positions), std::move(part.colors),
                          std::move(part.normals), std::move(part.coordinates)});
    }
    return target_.add_stream(source.name, std::make_shared<IndexedStream>(std::move(streamed)));
  }
  Mesh mesh{.name = source.name, .positions = {}, .triangles = {}};
  mesh.triangles.reserve(triangles);
  for (const Part& part : parts) read_triangles(part, nullptr, mesh);
  return target_.add_mesh(std::move(mesh));
}

std::optional<uint32_t> GltfMeshes::skinned_mesh(int64_t index, const std::vector<Affine>& joints,
                                                 int64_t skin, const std::string& place) {
  if (index < 0 || static_cast<size_t>(index) >= meshes_.size())
    fail(place, "names mesh {} of {}", index, meshes_.size());
  const auto [found, added] = skinned_.try_emplace({index, skin});
  if (!added) return found->second;
  known_[static_cast<size_t>(index)] = true;
  Mesh mesh{.name = gltf_.model.meshes[static_cast<size_t>(index)].name, .positions = {}, .triangles = {}};
  for (const Part& part : read_parts(static_cast<size_t>(index)))
    read_triangles(part, skinning(part, joints), mesh);
  return found->second = target_.add_mesh(std::move(mesh));
}

std::optional<GltfMeshes::Part> GltfMeshes::read_primitive(const GltfPrimitive& primitive,
                                                           const std::string& place) {
  constexpr int64_t points = 0, line_strip = 3, list = 4, strip = 5, fan = 6;
  if (primitive.mode >= points && primitive.mode <= line_strip) {
    target_.warn("primitives of points or lines were skipped");
    return std::nullopt;
  }
  if (primitive.mode < list || primitive.mode > fan) fail(place, "mode {} is not known", primitive.mode);
  const auto attribute = primitive.attributes.find("POSITION");
  if (attribute == primitive.attributes.end()) {
    target_.warn("primitives without positions were skipped");
    return std::nullopt;
  }
  if (primitive.material < -1 || primitive.material >= static_cast<int64_t>(materials_.size())) {
    fail(place, "names material {} of {}", primitive.material, materials_.size());
  }
  warn_of_attributes(primitive, target_);
  Part part;
  part.primitive = &primitive;
  part.positions = attribute->second;
  part.triangles.material = primitive.material < 0 ? 0 : materials_[static_cast<size_t>(primitive.material)];
  part.triangles.place = place;
  part.triangles.mode = primitive.mode == list    ? TriangleMode::list
                        : primitive.mode == strip ? TriangleMode::strip
                                                  : TriangleMode::fan;
  if (primitive.draco && read_draco(primitive, place, part)) return part;
  const GltfAccessor positions(gltf_, attribute->second, place);
  if (positions.components() != 3) fail(place, "positions of {} components", positions.components());
  if (positions.count() >= unnamed) fail(place, "more vertices than 32 bits can index");
  part.triangles.vertex_count = positions.count();
  part.can_stream = positions.can_stream();
  read_colors(primitive, place, part);
  read_normals(primitive, place, part);
  read_coordinates(primitive, place, part);
  read_indices(primitive, place, part);
  if (part.triangles.mode == TriangleMode::list)
    target_.warn("indices are left over after the last triangle", part.triangles.index_count() % 3);
  return part;
}

/// Of vertices; those that cannot be read are counted, and the primitive is drawn without them.
void GltfMeshes::read_colors(const GltfPrimitive& primitive, const std::string& place, Part& part) {
  const auto attribute = primitive.attributes.find("COLOR_0");
  if (attribute == primitive.attributes.end()) return;
  try {
    GltfAccessor accessor(gltf_, attribute->second, place);
    if (accessor.components() != 3 && accessor.components() != 4)
      fail(place, "colours of {} components", accessor.components());
    if (accessor.count() < part.triangles.vertex_count)
      fail(place, "{} colours of {} vertices", accessor.count(), part.triangles.vertex_count);
    part.colors = accessor.colors();
    if (accessor.can_stream() && part.colors->values.source) return;
    hold_in_memory(accessor, place, part.colors->values);
  } catch (const Error& error) {
    part.colors.reset();
    if (first_bad_colors_.empty())
      first_bad_colors_ = fmt::format(
          "primitives whose vertex colours cannot be read are drawn without, the first: {}", error.what());
    target_.warn(first_bad_colors_);
  }
}

/// Sparse elements, and zeros without a buffer, are assembled in memory, and read from there.
void GltfMeshes::hold_in_memory(GltfAccessor& accessor, const std::string& place, PositionTable& values) {
  accessor.load();
  values.stride = scalar_bytes(values.fields[0].type) * static_cast<size_t>(accessor.components());
  values.source = std::make_shared<StreamSource>(place, accessor.take_elements());
  values.offset = 0;
}

/// Of vertices, as their colours.
void GltfMeshes::read_normals(const GltfPrimitive& primitive, const std::string& place, Part& part) {
  const auto attribute = primitive.attributes.find("NORMAL");
  if (attribute == primitive.attributes.end()) return;
  try {
    GltfAccessor accessor(gltf_, attribute->second, place);
    if (accessor.components() != 3) fail(place, "normals of {} components", accessor.components());
    if (accessor.count() < part.triangles.vertex_count)
      fail(place, "{} normals of {} vertices", accessor.count(), part.triangles.vertex_count);
    part.normals = accessor.positions();
    if (!accessor.can_stream() || !part.normals->source) hold_in_memory(accessor, place, *part.normals);
  } catch (const Error& error) {
    part.normals.reset();
    if (first_bad_normals_.empty())
      first_bad_normals_ = fmt::format(
          "primitives whose normals cannot be read are drawn without, the first: {}", error.what());
    target_.warn(first_bad_normals_);
  }
}

/// Where the primitive is on the texture of its material; where that cannot be read it is counted, and the
/// primitive is drawn without.
void GltfMeshes::read_coordinates(const GltfPrimitive& primitive, const std::string& place, Part& part) {
  if (primitive.material < 0) return;
  const GltfSurface& surface = surfaces_[static_cast<size_t>(primitive.material)];
  if (surface.coordinates < 0) return;
  try {
    if (!part.unpacked) {
      const std::string name = fmt::format("TEXCOORD_{}", surface.coordinates);
      const auto attribute = primitive.attributes.find(name);
      if (attribute == primitive.attributes.end()) fail(place, "has no {}", name);
      GltfAccessor accessor(gltf_, attribute->second, place);
      if (accessor.components() != 2)
        fail(place, "texture coordinates of {} components", accessor.components());
      if (accessor.count() < part.triangles.vertex_count)
        fail(place, "{} texture coordinates of {} vertices", accessor.count(), part.triangles.vertex_count);
      part.coordinates.emplace(CoordinateTable{accessor.coordinates()});
      PositionTable& values = part.coordinates->values;
      if (!accessor.can_stream() || !values.source) hold_in_memory(accessor, place, values);
    } else if (!part.coordinates) {
      fail(place, "its compressed data hold no texture coordinates");
    }
  } catch (const Error& error) {
    part.coordinates.reset();
    if (first_bad_coordinates_.empty())
      first_bad_coordinates_ = fmt::format(
          "primitives whose texture coordinates cannot be read are drawn without textures, the first: {}",
          error.what());
    return target_.warn(first_bad_coordinates_);
  }
  // Turned counter-clockwise in the picture, in which v goes down.
  const GltfTextureTransform& transform = surface.transform;
  const double cosine = std::cos(transform.rotation), sine = std::sin(transform.rotation);
  part.coordinates->to = {cosine * transform.scale[0], sine * transform.scale[1],   transform.offset[0],
                          -sine * transform.scale[0],  cosine * transform.scale[1], transform.offset[1]};
}

/// False where the data cannot be unpacked, but the file holds them uncompressed too.
bool GltfMeshes::read_draco(const GltfPrimitive& primitive, const std::string& place, Part& part) {
  try {
    const int64_t set =
        primitive.material < 0 ? -1 : surfaces_[static_cast<size_t>(primitive.material)].coordinates;
    GltfDracoMesh mesh = unpack_draco(gltf_, *primitive.draco, set, place);
    part.triangles.vertex_count = mesh.positions.count;
    part.triangles.indices = std::move(mesh.indices);
    part.triangles.mode = TriangleMode::list;
    part.unpacked = std::move(mesh.positions);
    part.colors = std::move(mesh.colors);
    part.normals = std::move(mesh.normals);
    if (mesh.coordinates) part.coordinates.emplace(CoordinateTable{std::move(*mesh.coordinates)});
    part.can_stream = true;
    read_coordinates(primitive, place, part);
    return true;
  } catch (const Error&) {
    const auto& accessors = gltf_.model.accessors;
    const bool has_copy = part.positions >= 0 && static_cast<size_t>(part.positions) < accessors.size() &&
                          accessors[static_cast<size_t>(part.positions)].view >= 0;
    if (!has_copy) throw;
    return false;
  }
}

void GltfMeshes::read_indices(const GltfPrimitive& primitive, const std::string& place, Part& part) {
  if (primitive.indices < -1)
    fail(place, "names accessor {} of {}", primitive.indices, gltf_.model.accessors.size());
  if (primitive.indices == -1) return;
  GltfAccessor accessor(gltf_, primitive.indices, place);
  if (!accessor.holds_indices()) fail(place, "accessor {} does not hold indices", primitive.indices);
  part.triangles.indices = accessor.indices();
  if (accessor.can_stream()) return;
  // Sparse indices are assembled in memory, and read from there.
  accessor.load();
  part.triangles.indices->source = std::make_shared<StreamSource>(place, accessor.take_elements());
  part.triangles.indices->offset = 0;
  part.triangles.indices->stride = scalar_bytes(part.triangles.indices->type);
}

glm::dvec3 GltfMeshes::Positions::at(uint32_t vertex) {
  if (cache) return cache->at(vertex);
  return {accessor->component(vertex, 0), accessor->component(vertex, 1), accessor->component(vertex, 2)};
}

GltfMeshes::Positions& GltfMeshes::positions(int64_t accessor, const std::string& place) {
  if (last_accessor_ == accessor) return *last_positions_;
  last_accessor_ = -1;
  last_positions_.reset();
  last_positions_.emplace(Positions{GltfAccessor(gltf_, accessor, place), nullptr});
  GltfAccessor& positions = *last_positions_->accessor;
  if (positions.can_stream()) {
    last_positions_->cache = std::make_unique<PositionCache>(positions.positions());
  } else {
    positions.load();
  }
  last_accessor_ = accessor;
  return *last_positions_;
}

/// What joints do to a direction at a vertex.
VertexNormal GltfMeshes::moved_normal(const Move& move, uint32_t vertex, const glm::dvec3& position,
                                      const VertexNormal& normal) {
  if (!move || !has_normal(normal)) return normal;
  return to_vertex_normal(move(vertex, position + direction_of(normal)) - move(vertex, position));
}

/// Reads the triangles, and those vertices of the accessor that they use.
void GltfMeshes::read_triangles(const Part& part, const Move& move, Mesh& mesh) {
  std::optional<Positions> unpacked;
  if (part.unpacked)
    unpacked.emplace(Positions{std::nullopt, std::make_unique<PositionCache>(*part.unpacked)});
  Positions& source = unpacked ? *unpacked : positions(part.positions, part.triangles.place);
  std::optional<ColorCache> colors;
  if (part.colors) {
    colors.emplace(*part.colors);
    mesh.colors.resize(mesh.positions.size());
  }
  std::optional<NormalCache> normals;
  if (part.normals) {
    normals.emplace(*part.normals);
    mesh.normals.resize(mesh.positions.size());
  }
  std::optional<CoordinateCache> coordinates;
  if (part.coordinates) {
    coordinates.emplace(*part.coordinates);
    mesh.coordinates.resize(mesh.positions.size());
  }
  std::vector<std::array<uint32_t, 3>> triangles;
  uint32_t lowest = unnamed, highest = 0;
  IndexedTriangles reader(part.triangles);
  for (std::array<uint32_t, 3> corners; reader.next(corners);) {
    triangles.push_back(corners);
    lowest = std::min({lowest, corners[0], corners[1], corners[2]});
    highest = std::max({highest, corners[0], corners[1], corners[2]});
  }
  if (triangles.empty()) return;
  // Vertex numbers are mapped by a table if they are close to each other, otherwise by a hash map.
  const bool close = highest - lowest < 16 * triangles.size() + 65536;
  if (close) renamed_.assign(size_t{highest - lowest} + 1, unnamed);
  std::unordered_map<uint32_t, uint32_t> scattered;
  for (const auto& corners : triangles) {
    Triangle triangle{{}, part.triangles.material};
    for (size_t k = 0; k < 3; ++k) {
      uint32_t& name =
          close ? renamed_[corners[k] - lowest] : scattered.try_emplace(corners[k], unnamed).first->second;
      if (name == unnamed) {
        if (mesh.positions.size() >= unnamed)
          fail(part.triangles.place, "more vertices than 32 bits can index");
        name = static_cast<uint32_t>(mesh.positions.size());
        const glm::dvec3 position = source.at(corners[k]);
        mesh.positions.push_back(move ? move(corners[k], position) : position);
        if (colors || !mesh.colors.empty())
          mesh.colors.push_back(colors ? colors->at(corners[k]) : VertexColor{});
        if (normals || !mesh.normals.empty())
          mesh.normals.push_back(normals ? moved_normal(move, corners[k], position, normals->at(corners[k]))
                                         : VertexNormal{});
        if (coordinates || !mesh.coordinates.empty())
          mesh.coordinates.push_back(coordinates ? coordinates->at(corners[k]) : TextureCoordinates{});
      }
      triangle.vertices[k] = name;
    }
    mesh.triangles.push_back(triangle);
  }
}

}  // namespace triptych
