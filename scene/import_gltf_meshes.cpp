#include "base/error.hpp"
#include "scene/import_gltf.hpp"

#include <algorithm>
#include <limits>

namespace triptych {

namespace {

/// The corners of a triangle list, strip or fan, three a triangle; strips keep their winding.
std::vector<uint32_t> triangle_corners(const std::vector<uint32_t>& indices, int mode) {
  std::vector<uint32_t> corners;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    corners.assign(indices.begin(), indices.end() - static_cast<std::ptrdiff_t>(indices.size() % 3));
    return corners;
  }
  for (size_t i = 2; i < indices.size(); ++i) {
    const bool fan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
    const uint32_t a = fan ? indices[0] : indices[i - 2 + (i & 1)];
    const uint32_t b = fan ? indices[i - 1] : indices[i - 1 - (i & 1)];
    corners.insert(corners.end(), {a, b, indices[i]});
  }
  return corners;
}

std::vector<uint32_t> read_indices(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive,
                                   size_t vertex_count, const std::string& place) {
  if (primitive.indices < -1)
    fail(place, "names accessor {} of {}", primitive.indices, gltf.accessors.size());
  if (primitive.indices == -1) {
    std::vector<uint32_t> indices(vertex_count);
    for (size_t i = 0; i < vertex_count; ++i) indices[i] = static_cast<uint32_t>(i);
    return indices;
  }
  const GltfAccessor accessor(gltf, primitive.indices, place);
  if (!accessor.holds_indices()) fail(place, "accessor {} does not hold indices", primitive.indices);
  std::vector<uint32_t> indices(accessor.count());
  for (size_t i = 0; i < indices.size(); ++i) {
    indices[i] = accessor.index(i);
    if (indices[i] >= vertex_count)
      fail(place, "index {} names vertex {} of {}", i, indices[i], vertex_count);
  }
  return indices;
}

void warn_of_attributes(const tinygltf::Primitive& primitive, FileImport& target) {
  if (primitive.attributes.count("COLOR_0"))
    target.warn("primitives with vertex colours, which are not drawn yet");
  if (primitive.attributes.count("JOINTS_0"))
    target.warn("primitives with a skin, drawn as they stand in the file");
  if (!primitive.targets.empty())
    target.warn("primitives with morph targets, drawn as they stand in the file");
}

}  // namespace

GltfMeshes::GltfMeshes(const tinygltf::Model& gltf, FileImport& target)
    : gltf_(gltf), target_(target), known_(gltf.meshes.size()), meshes_(gltf.meshes.size()) {
  for (const auto& material : gltf.materials) read_material(material);
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
  const auto& source = gltf_.meshes[index];
  Mesh mesh{.name = source.name, .positions = {}, .triangles = {}};
  for (size_t i = 0; i < source.primitives.size(); ++i) {
    read_primitive(source.primitives[i], fmt::format("{}: mesh {} primitive {}", target_.place(), index, i),
                   mesh);
  }
  return target_.add_mesh(std::move(mesh));
}

void GltfMeshes::read_primitive(const tinygltf::Primitive& primitive, const std::string& place, Mesh& mesh) {
  constexpr uint32_t unnamed = std::numeric_limits<uint32_t>::max();
  if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode <= TINYGLTF_MODE_LINE_STRIP) {
    return target_.warn("primitives of points or lines were skipped");
  }
  if (primitive.mode < TINYGLTF_MODE_TRIANGLES || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    fail(place, "mode {} is not known", primitive.mode);
  }
  const auto attribute = primitive.attributes.find("POSITION");
  if (attribute == primitive.attributes.end())
    return target_.warn("primitives without positions were skipped");
  const GltfAccessor positions(gltf_, attribute->second, place);
  if (positions.components() != 3) fail(place, "positions of {} components", positions.components());
  if (positions.count() >= unnamed) fail(place, "more vertices than 32 bits can index");
  if (primitive.material < -1 || primitive.material >= static_cast<int>(materials_.size())) {
    fail(place, "names material {} of {}", primitive.material, materials_.size());
  }
  const uint32_t material = primitive.material < 0 ? 0 : materials_[static_cast<size_t>(primitive.material)];
  warn_of_attributes(primitive, target_);
  const std::vector<uint32_t> indices = read_indices(gltf_, primitive, positions.count(), place);
  if (primitive.mode == TINYGLTF_MODE_TRIANGLES)
    target_.warn("indices are left over after the last triangle", indices.size() % 3);

  // Files often keep the vertices of many meshes in one accessor: each mesh takes those that it uses.
  const std::vector<uint32_t> corners = triangle_corners(indices, primitive.mode);
  if (renamed_.size() < positions.count()) renamed_.resize(positions.count(), unnamed);
  mesh.triangles.reserve(mesh.triangles.size() + corners.size() / 3);
  for (size_t i = 0; i < corners.size(); i += 3) {
    Triangle triangle{{}, material};
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t vertex = corners[i + k];
      if (renamed_[vertex] == unnamed) {
        if (mesh.positions.size() >= unnamed) fail(place, "more vertices than 32 bits can index");
        renamed_[vertex] = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.emplace_back(positions.component(vertex, 0), positions.component(vertex, 1),
                                    positions.component(vertex, 2));
      }
      triangle.vertices[k] = renamed_[vertex];
    }
    mesh.triangles.push_back(triangle);
  }
  for (const uint32_t vertex : corners) renamed_[vertex] = unnamed;
}

}  // namespace triptych
