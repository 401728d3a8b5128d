#include "base/error.hpp"
#include "model/import/import_gltf.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace triptych {

namespace {

constexpr uint32_t unnamed = std::numeric_limits<uint32_t>::max();

void warn_of_attributes(const tinygltf::Primitive& primitive, FileImport& target) {
  if (primitive.attributes.count("COLOR_0"))
    target.warn("primitives with vertex colours, which are not drawn yet");
  if (primitive.attributes.count("JOINTS_0"))
    target.warn("primitives with a skin, drawn as stored in the file");
  if (!primitive.targets.empty()) target.warn("primitives with morph targets, drawn as stored in the file");
}

}  // namespace

GltfMeshes::GltfMeshes(const GltfFile& gltf, FileImport& target)
    : gltf_(gltf), target_(target), known_(gltf.model.meshes.size()), meshes_(gltf.model.meshes.size()) {
  for (const auto& material : gltf.model.materials) read_material(material);
}

void GltfMeshes::read_material(const tinygltf::Material& material) {
  const auto& factor = material.pbrMetallicRoughness.baseColorFactor;
  const std::string place = fmt::format("{}: material {}", target_.place(), materials_.size());
  if (factor.size() != 4) fail(place, "a base colour of {} numbers", factor.size());
  Material result;
  for (int i = 0; i < 4; ++i) {
    result.base_color[i] = static_cast<float>(std::clamp(factor[static_cast<size_t>(i)], 0.0, 1.0));
  }
  if (material.pbrMetallicRoughness.baseColorTexture.index >= 0) target_.warn("textures are not drawn yet");
  if (material.alphaMode != "OPAQUE") target_.warn("transparent materials are drawn opaque");
  materials_.push_back(target_.add_material(result));
}

std::optional<uint32_t> GltfMeshes::mesh(int index, const std::string& place) {
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

std::optional<uint32_t> GltfMeshes::read_mesh(size_t index) {
  const auto& source = gltf_.model.meshes[index];
  std::vector<Part> parts;
  uint64_t triangles = 0;
  bool can_stream = true;
  for (size_t i = 0; i < source.primitives.size(); ++i) {
    auto part = read_primitive(source.primitives[i],
                               fmt::format("{}: mesh {} primitive {}", target_.place(), index, i));
    if (!part || part->triangles.triangle_count() == 0) continue;
    triangles += part->triangles.triangle_count();
    can_stream = can_stream && part->can_stream;
    parts.push_back(std::move(*part));
  }
  if (parts.empty()) return std::nullopt;
  if (can_stream && target_.should_stream(triangles)) {
    std::vector<IndexedStream::Part> streamed;
    for (Part& part : parts) {
      const GltfAccessor positions(gltf_, part.positions, part.triangles.place);
      streamed.push_back({std::move(part.triangles), positions.positions()});
    }
    return target_.add_stream(source.name, std::make_shared<IndexedStream>(std::move(streamed)));
  }
  Mesh mesh{.name = source.name, .positions = {}, .triangles = {}};
  mesh.triangles.reserve(triangles);
  for (const Part& part : parts) read_triangles(part, mesh);
  return target_.add_mesh(std::move(mesh));
}

std::optional<GltfMeshes::Part> GltfMeshes::read_primitive(const tinygltf::Primitive& primitive,
                                                           const std::string& place) {
  if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode <= TINYGLTF_MODE_LINE_STRIP) {
    target_.warn("primitives of points or lines were skipped");
    return std::nullopt;
  }
  if (primitive.mode < TINYGLTF_MODE_TRIANGLES || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    fail(place, "mode {} is not known", primitive.mode);
  }
  const auto attribute = primitive.attributes.find("POSITION");
  if (attribute == primitive.attributes.end()) {
    target_.warn("primitives without positions were skipped");
    return std::nullopt;
  }
  const GltfAccessor positions(gltf_, attribute->second, place);
  if (positions.components() != 3) fail(place, "positions of {} components", positions.components());
  if (positions.count() >= unnamed) fail(place, "more vertices than 32 bits can index");
  if (primitive.material < -1 || primitive.material >= static_cast<int>(materials_.size())) {
    fail(place, "names material {} of {}", primitive.material, materials_.size());
  }
  warn_of_attributes(primitive, target_);
  Part part{{}, attribute->second, positions.can_stream()};
  part.triangles.vertex_count = positions.count();
  part.triangles.material = primitive.material < 0 ? 0 : materials_[static_cast<size_t>(primitive.material)];
  part.triangles.place = place;
  part.triangles.mode = primitive.mode == TINYGLTF_MODE_TRIANGLES        ? TriangleMode::list
                        : primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ? TriangleMode::strip
                                                                         : TriangleMode::fan;
  read_indices(primitive, place, part);
  if (part.triangles.mode == TriangleMode::list)
    target_.warn("indices are left over after the last triangle", part.triangles.index_count() % 3);
  return part;
}

void GltfMeshes::read_indices(const tinygltf::Primitive& primitive, const std::string& place, Part& part) {
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
  return {accessor.component(vertex, 0), accessor.component(vertex, 1), accessor.component(vertex, 2)};
}

GltfMeshes::Positions& GltfMeshes::positions(int accessor, const std::string& place) {
  if (last_accessor_ == accessor) return *last_positions_;
  last_positions_.reset();
  last_positions_.emplace(Positions{GltfAccessor(gltf_, accessor, place), nullptr});
  GltfAccessor& positions = last_positions_->accessor;
  if (positions.can_stream()) {
    last_positions_->cache = std::make_unique<PositionCache>(positions.positions());
  } else {
    positions.load();
  }
  last_accessor_ = accessor;
  return *last_positions_;
}

/// Reads the triangles, and those vertices of the accessor that they use.
void GltfMeshes::read_triangles(const Part& part, Mesh& mesh) {
  Positions& source = positions(part.positions, part.triangles.place);
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
        mesh.positions.push_back(source.at(corners[k]));
      }
      triangle.vertices[k] = name;
    }
    mesh.triangles.push_back(triangle);
  }
}

}  // namespace triptych
