#include "launch/kit/kit_assimp.hpp"

#include "base/error.hpp"
#include "samples/kit/kit_plan.hpp"

#include <algorithm>
#include <array>
#include <assimp/Exporter.hpp>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>
#include <map>
#include <memory>
#include <vector>

namespace triptych {

namespace {

/// How a format is meant, and what Debian's Assimp 5.2 makes of it. It converts neither units nor axes.
struct Convention {
  const char* format;
  const char* exporter;
  double per_metre = 1;  ///< units
  bool z_up = false;
  bool vertex_colors = false;  ///< in place of materials
};

// PLY and FBX are text: the binary PLY's colours are not of the type that its header names, and the binary
// FBX lacks the zeros that end its records, so that nothing reads it. In 3MF it writes no colour rightly.
constexpr std::array conventions = {Convention{.format = "obj", .exporter = "obj"},
                                    Convention{.format = "ply", .exporter = "ply", .vertex_colors = true},
                                    Convention{.format = "stl", .exporter = "stlb"},
                                    Convention{.format = "dae", .exporter = "collada"},
                                    Convention{.format = "x3d", .exporter = "x3d"},
                                    Convention{.format = "fbx", .exporter = "fbxa", .per_metre = 100},
                                    Convention{.format = "3ds", .exporter = "3ds", .z_up = true}};

const Convention* convention_of(const std::string& format) {
  const auto found = std::find_if(conventions.begin(), conventions.end(),
                                  [&](const Convention& convention) { return format == convention.format; });
  return found == conventions.end() ? nullptr : found;
}

aiVector3D vector_of(const glm::dvec3& point) {
  return {static_cast<ai_real>(point.x), static_cast<ai_real>(point.y), static_cast<ai_real>(point.z)};
}

/// An array as Assimp's scenes own them.
template <typename Value>
Value* owned(const std::vector<Value>& values) {
  auto* array = new Value[values.size()];
  std::copy(values.begin(), values.end(), array);
  return array;
}

/// `above`: added to each channel's byte, where the exporter makes bytes and cuts fractions off.
aiColor4D color_of(const KitSolid& solid, double above = 0) {
  const auto channel = [&](double byte) { return static_cast<ai_real>((byte + above) / 255); };
  const auto& [red, green, blue] = solid.colour;
  return {channel(red), channel(green), channel(blue), 1};
}

aiMesh* new_mesh(const KitSolid& solid, const Convention& convention) {
  const KitMesh mesh = mesh_of(solid);
  auto* result = new aiMesh;
  result->mName = solid.name;
  result->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  std::vector<aiVector3D> positions;
  for (const glm::dvec3& position : mesh.positions)
    positions.push_back(
        vector_of(convention.per_metre * (convention.z_up ? position : turned_y_up(position))));
  result->mNumVertices = static_cast<unsigned>(positions.size());
  result->mVertices = owned(positions);
  if (convention.vertex_colors)
    result->mColors[0] = owned(std::vector<aiColor4D>(positions.size(), color_of(solid, 0.5)));
  result->mNumFaces = static_cast<unsigned>(mesh.triangles.size());
  result->mFaces = new aiFace[mesh.triangles.size()];
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    result->mFaces[i].mNumIndices = 3;
    result->mFaces[i].mIndices = new unsigned[3];
    std::copy(mesh.triangles[i].begin(), mesh.triangles[i].end(), result->mFaces[i].mIndices);
  }
  return result;
}

aiMaterial* new_material(const KitSolid& solid) {
  auto* material = new aiMaterial;
  const auto& [red, green, blue] = solid.colour;
  const aiString name(fmt::format("colour_{}_{}_{}", red, green, blue));
  material->AddProperty(&name, AI_MATKEY_NAME);
  const aiColor4D color = color_of(solid);
  material->AddProperty(&color, 1, AI_MATKEY_COLOR_DIFFUSE);
  return material;
}

void set_children(aiNode& node, const std::vector<aiNode*>& children) {
  for (aiNode* child : children) child->mParent = &node;
  node.mNumChildren = static_cast<unsigned>(children.size());
  node.mChildren = owned(children);
}

/// A node for each storey, and one in it for each of its solids.
aiNode* new_nodes() {
  std::vector<std::vector<aiNode*>> solids(kit_storeys().size());
  for (size_t i = 0; i < kit_solids().size(); ++i) {
    auto* node = new aiNode(kit_solids()[i].name);
    node->mNumMeshes = 1;
    node->mMeshes = owned(std::vector<unsigned>{static_cast<unsigned>(i)});
    solids[kit_solids()[i].storey].push_back(node);
  }
  std::vector<aiNode*> storeys;
  for (size_t i = 0; i < solids.size(); ++i) {
    storeys.push_back(new aiNode(kit_storeys()[i].name));
    set_children(*storeys.back(), solids[i]);
  }
  auto* root = new aiNode("kit");
  set_children(*root, storeys);
  return root;
}

std::unique_ptr<aiScene> scene_for(const Convention& convention) {
  auto scene = std::make_unique<aiScene>();
  std::vector<aiMesh*> meshes;
  std::vector<aiMaterial*> materials;
  std::map<std::array<uint8_t, 3>, unsigned> known;
  for (const KitSolid& solid : kit_solids()) {
    const auto [found, added] = known.try_emplace(solid.colour, static_cast<unsigned>(materials.size()));
    if (added) materials.push_back(new_material(solid));
    meshes.push_back(new_mesh(solid, convention));
    meshes.back()->mMaterialIndex = found->second;
  }
  scene->mNumMeshes = static_cast<unsigned>(meshes.size());
  scene->mMeshes = owned(meshes);
  scene->mNumMaterials = static_cast<unsigned>(materials.size());
  scene->mMaterials = owned(materials);
  scene->mRootNode = new_nodes();
  return scene;
}

}  // namespace

bool assimp_writes(const std::string& format) { return convention_of(format) != nullptr; }

void write_kit_with_assimp(const std::string& format, const std::filesystem::path& file) {
  const Convention& convention = *convention_of(format);
  const auto scene = scene_for(convention);
  Assimp::Exporter exporter;
  if (exporter.Export(scene.get(), convention.exporter, file.string()) != aiReturn_SUCCESS)
    fail("Assimp", "{}", exporter.GetErrorString());
}

}  // namespace triptych
