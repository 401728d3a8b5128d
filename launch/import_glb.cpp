#include "launch/import_glb.hpp"

#include "base/descriptor.hpp"
#include "base/error.hpp"
#include "launch/glb_textures.hpp"
#include "model/import/display_color.hpp"
#include "model/import/triangulate.hpp"

#include <algorithm>
#include <array>
#include <assimp/ColladaMetaData.h>
#include <assimp/material.h>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace triptych {

namespace {

using nlohmann::json;

/// Buffered writing to a descriptor.
class Output {
 public:
  Output(int descriptor, std::string place) : descriptor_(descriptor), place_(std::move(place)) {}

  template <typename Value>
  void write(const Value& value) {
    write(std::as_bytes(std::span(&value, 1)));
  }
  // Not inlined: g++ 12 sees overflows in vectors that grow where there are none.
  [[gnu::noinline]] void write(std::span<const std::byte> bytes) {
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    if (buffer_.size() >= size_t{1} << 20) flush();
  }
  void flush() {
    write_all(descriptor_, buffer_, place_ + ": its temporary file");
    buffer_.clear();
  }

 private:
  int descriptor_;
  std::string place_;
  std::vector<std::byte> buffer_;
};

uint64_t triangle_count(const aiMesh& mesh) {
  uint64_t count = 0;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) count += std::max(mesh.mFaces[i].mNumIndices, 2u) - 2;
  return count;
}

/// Diffuse colours are what is displayed.
aiColor4D linear_color(const aiColor4D& color) {
  const glm::vec4 linear = from_display_color(static_cast<double>(color.r), static_cast<double>(color.g),
                                              static_cast<double>(color.b));
  return {linear.r, linear.g, linear.b, color.a};
}

/// Assimp makes one of this name up where a file has none.
bool is_made_up(const aiMaterial& material) {
  return std::string_view(material.GetName().C_Str()) == AI_DEFAULT_MATERIAL_NAME;
}

json material_of(const aiMaterial& material) {
  aiColor4D color(0.8f, 0.8f, 0.8f, 1);
  if (!is_made_up(material) && material.Get(AI_MATKEY_BASE_COLOR, color) != aiReturn_SUCCESS)
    if (material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) color = linear_color(color);
  float opacity = 1;
  if (material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS) color.a = opacity;
  json factor = json::array();
  for (const float value : {color.r, color.g, color.b, color.a})
    factor.push_back(std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 1.0f);
  json result = {{"pbrMetallicRoughness", {{"baseColorFactor", factor}}}};
  if (factor[3] < 1) result["alphaMode"] = "BLEND";
  return result;
}

/// The meshes with triangles and where their bytes go: positions, vertex colours, normals and places on
/// textures if there are any, indices.
struct Layout {
  json meshes = json::array(), views = json::array(), accessors = json::array();
  std::vector<int> mesh_of;  ///< the scene's mesh to the file's; −1 without triangles
  uint64_t bytes = 0;
};

Layout lay_out(const aiScene& scene, const GlbTextures& textures, ConversionNotes& notes) {
  Layout layout;
  const auto add = [&](uint64_t bytes, uint64_t count, int component, const char* type) {
    layout.views.push_back({{"buffer", 0}, {"byteOffset", layout.bytes}, {"byteLength", bytes}});
    layout.accessors.push_back({{"bufferView", layout.views.size() - 1},
                                {"componentType", component},
                                {"count", count},
                                {"type", type}});
    layout.bytes += bytes;
    return layout.accessors.size() - 1;
  };
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    const uint64_t triangles = triangle_count(mesh);
    layout.mesh_of.push_back(triangles == 0 || !mesh.mVertices ? -1 : static_cast<int>(layout.meshes.size()));
    if (layout.mesh_of.back() < 0) {
      ++notes["meshes without triangles (points, lines) were skipped"];
      continue;
    }
    if (mesh.HasBones()) ++notes["meshes with a skin, drawn as stored in the file"];
    const auto positions = add(uint64_t{mesh.mNumVertices} * 12, mesh.mNumVertices, 5126, "VEC3");
    json primitive = {{"attributes", {{"POSITION", positions}}}};
    const bool colored = mesh.HasVertexColors(0);
    if (colored)
      primitive["attributes"]["COLOR_0"] =
          add(uint64_t{mesh.mNumVertices} * 12, mesh.mNumVertices, 5126, "VEC3");
    if (mesh.HasNormals())
      primitive["attributes"]["NORMAL"] =
          add(uint64_t{mesh.mNumVertices} * 12, mesh.mNumVertices, 5126, "VEC3");
    if (textures.is_textured(mesh))
      primitive["attributes"]["TEXCOORD_0"] =
          add(uint64_t{mesh.mNumVertices} * 8, mesh.mNumVertices, 5126, "VEC2");
    primitive["indices"] = add(triangles * 12, triangles * 3, 5125, "SCALAR");
    if (mesh.mMaterialIndex < scene.mNumMaterials) {
      // Vertex colours of what has no material are not multiplied by that of others.
      if (!colored || !is_made_up(*scene.mMaterials[mesh.mMaterialIndex]))
        primitive["material"] = mesh.mMaterialIndex;
    }
    const std::string name(mesh.mName.C_Str());
    layout.meshes.push_back({{"name", name}, {"primitives", {primitive}}});
  }
  return layout;
}

json matrix_of(const aiMatrix4x4& m, const std::string& place) {
  const std::array<float, 12> values = {m.a1, m.b1, m.c1, m.a2, m.b2, m.c2,
                                        m.a3, m.b3, m.c3, m.a4, m.b4, m.c4};
  for (const float value : values) {
    if (!std::isfinite(value)) fail(place, "holds a transform that is not finite");
  }
  json matrix = json::array();
  for (size_t i = 0; i < values.size(); ++i) {
    matrix.push_back(values[i]);
    if (i % 3 == 2) matrix.push_back(i == 11 ? 1 : 0);
  }
  return matrix;
}

/// What the file calls it: Assimp makes names up for nodes that FBX does not have, and for those that COLLADA
/// does not name, which may have an id.
std::string name_of(const aiNode& node) {
  std::string name(node.mName.C_Str());
  if (name.find("_$AssimpFbx$_") != std::string::npos) return "";
  if (!name.starts_with("$ColladaAutoName$_")) return name;
  aiString id;
  if (node.mMetaData && node.mMetaData->Get(AI_METADATA_COLLADA_ID, id)) return id.C_Str();
  return "";
}

/// In glTF a node holds one mesh: further ones become children.
json nodes_of(const aiScene& scene, const Layout& layout, const glm::dmat3& to_model,
              const std::string& place) {
  json nodes = json::array();
  json matrix = json::array();
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row)
      matrix.push_back(column < 3 && row < 3 ? to_model[column][row] : column == row ? 1.0 : 0.0);
  }
  nodes.push_back({{"matrix", matrix}, {"children", {1}}});
  struct Open {
    const aiNode* node;
    size_t index;
  };
  std::vector<Open> open = {{scene.mRootNode, 1}};
  nodes.emplace_back();
  while (!open.empty()) {
    const auto [node, index] = open.back();
    open.pop_back();
    json entry = {{"matrix", matrix_of(node->mTransformation, place)}};
    if (const std::string name = name_of(*node); node != scene.mRootNode && !name.empty())
      entry["name"] = name;
    json children = json::array();
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      if (node->mMeshes[i] >= layout.mesh_of.size()) fail(place, "names a mesh that is not there");
      const int mesh = layout.mesh_of[node->mMeshes[i]];
      if (mesh < 0) continue;
      children.push_back(nodes.size());
      nodes.push_back({{"mesh", mesh}});
    }
    for (unsigned i = 0; i < node->mNumChildren; ++i) {
      children.push_back(nodes.size());
      open.push_back({node->mChildren[i], nodes.size()});
      nodes.emplace_back();
    }
    if (!children.empty()) entry["children"] = children;
    nodes[index] = entry;
  }
  return nodes;
}

void write_mesh(const aiMesh& mesh, const GlbTextures& textures, Output& output, const std::string& place,
                ConversionNotes& notes) {
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& vertex = mesh.mVertices[i];
    output.write(std::array<float, 3>{vertex.x, vertex.y, vertex.z});
  }
  for (unsigned i = 0; mesh.HasVertexColors(0) && i < mesh.mNumVertices; ++i) {
    const aiColor4D color = linear_color(mesh.mColors[0][i]);  // those displayed, too
    output.write(std::array<float, 3>{color.r, color.g, color.b});
  }
  for (unsigned i = 0; mesh.HasNormals() && i < mesh.mNumVertices; ++i) {
    const aiVector3D& normal = mesh.mNormals[i];
    output.write(std::array<float, 3>{normal.x, normal.y, normal.z});
  }
  for (unsigned i = 0; textures.is_textured(mesh) && i < mesh.mNumVertices; ++i) {
    const glm::vec2 own = textures.place(mesh, i);
    output.write(std::array<float, 2>{own.x, own.y});
  }
  std::vector<glm::dvec3> corners;
  std::vector<std::array<uint32_t, 3>> triangles;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    corners.clear();
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= mesh.mNumVertices)
        fail(place, "has a face that names a vertex that is not there");
      const aiVector3D& vertex = mesh.mVertices[face.mIndices[k]];
      corners.emplace_back(vertex.x, vertex.y, vertex.z);
    }
    if (corners.size() < 3) ++notes["points or lines were skipped"];
    if (corners.size() > max_clipped_corners) ++notes[std::string(fan_warning)];
    triangulate(corners, triangles);
    for (const auto& [a, b, c] : triangles)
      output.write(std::array<uint32_t, 3>{face.mIndices[a], face.mIndices[b], face.mIndices[c]});
  }
}

}  // namespace

void write_glb(const aiScene& scene, const glm::dmat3& to_model, int descriptor, const std::string& place,
               ConversionNotes& notes) {
  if (!scene.mRootNode) fail(place, "holds no scene");
  GlbTextures textures(scene, notes);
  json materials = json::array();
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    materials.push_back(material_of(*scene.mMaterials[i]));
    textures.add(i, materials.back());
  }
  const Layout layout = lay_out(scene, textures, notes);
  if (layout.meshes.empty()) fail(place, "holds no triangles");
  json document = {{"asset", {{"version", "2.0"}}}, {"buffers", {{{"byteLength", layout.bytes}}}},
                   {"bufferViews", layout.views},   {"accessors", layout.accessors},
                   {"meshes", layout.meshes},       {"nodes", nodes_of(scene, layout, to_model, place)},
                   {"scenes", {{{"nodes", {0}}}}},  {"scene", 0}};
  if (!materials.empty()) document["materials"] = materials;
  textures.write_to(document);
  std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace);
  document = {};
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const uint64_t size = 28 + text.size() + layout.bytes;
  if (size > std::numeric_limits<uint32_t>::max()) fail(place, "holds more than 4 GiB of geometry");

  Output output(descriptor, place);
  output.write(std::array<uint32_t, 5>{0x46546c67, 2, static_cast<uint32_t>(size),
                                       static_cast<uint32_t>(text.size()), 0x4e4f534a});
  output.write(std::as_bytes(std::span(text)));
  output.write(std::array<uint32_t, 2>{static_cast<uint32_t>(layout.bytes), 0x004e4942});
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    if (layout.mesh_of[i] >= 0) write_mesh(*scene.mMeshes[i], textures, output, place, notes);
  }
  output.flush();
}

double largest_coordinate_of(const aiScene& scene) {
  double largest = 0;
  const auto take = [&](float value) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(static_cast<double>(value)));
  };
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    for (unsigned k = 0; mesh.mVertices && k < mesh.mNumVertices; ++k) {
      take(mesh.mVertices[k].x), take(mesh.mVertices[k].y), take(mesh.mVertices[k].z);
    }
  }
  std::vector<const aiNode*> open = {scene.mRootNode};
  while (!open.empty()) {
    const aiNode* node = open.back();
    open.pop_back();
    if (!node) continue;
    take(node->mTransformation.a4), take(node->mTransformation.b4), take(node->mTransformation.c4);
    open.insert(open.end(), node->mChildren, node->mChildren + node->mNumChildren);
  }
  return largest;
}

}  // namespace triptych
