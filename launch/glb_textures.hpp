// The base-colour textures of what Assimp read, as glTF has them.
#pragma once

#include "launch/import_glb.hpp"

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace triptych {

/// Collects the images, textures and samplers of materials.
class GlbTextures {
 public:
  explicit GlbTextures(const aiScene& scene, ConversionNotes& notes)
      : scene_(scene), notes_(notes), uses_(scene.mNumMaterials) {}

  /// Gives the glTF material of that number its texture, if it has one: images are named as they stand in
  /// the file, or held by it.
  void add(unsigned material, nlohmann::json& target);
  /// Adds what was collected.
  void write_to(nlohmann::json& document) const;

  /// Whether a mesh's texture coordinates are wanted.
  bool is_textured(const aiMesh& mesh) const { return use_of(mesh) != nullptr; }
  /// Of a vertex of such a mesh, from the upper left corner.
  glm::vec2 place(const aiMesh& mesh, unsigned vertex) const;

 private:
  /// How a material's texture lies.
  struct Use {
    unsigned channel = 0;
    aiUVTransform transform;
  };
  const Use* use_of(const aiMesh& mesh) const;
  std::optional<size_t> image(const std::string& path);

  const aiScene& scene_;
  ConversionNotes& notes_;
  std::vector<std::optional<Use>> uses_;
  std::vector<std::pair<std::string, size_t>> known_;
  nlohmann::json images_ = nlohmann::json::array(), textures_ = nlohmann::json::array(),
                 samplers_ = nlohmann::json::array();
};

}  // namespace triptych
