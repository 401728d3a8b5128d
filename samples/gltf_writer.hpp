// Writes a glTF 2.0 scene of shared, flat-coloured meshes: `scene.gltf` and, streamed, `scene.bin`, or the
// same under another name.
#pragma once

#include "base/file.hpp"
#include "samples/mesh_part.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// Meshes go to the buffer as they come; the JSON is written by finish(). Without it, nothing appears in the
/// folder.
class GltfWriter {
 public:
  /// Makes the folder. Error if that fails.
  GltfWriter(const std::filesystem::path& folder, const std::string& generator, std::string name = "scene");

  /// One primitive for each part. Returns the mesh's number.
  size_t add_mesh(const std::string& name, const std::vector<MeshPart>& parts);
  /// The same with parts that are made when they are written: only one is in memory at a time.
  size_t add_mesh(const std::string& name, size_t count, const std::function<MeshPart(size_t)>& make_part);
  /// Places a mesh: a node at the scene's top, or below another node.
  void add_node(const std::string& name, size_t mesh, const glm::dmat4& transform,
                std::optional<size_t> parent = {});
  /// A node at the scene's top that places nothing itself. Returns its number.
  size_t add_parent(const std::string& name, const glm::dvec3& translation);
  /// The same where the node may move: at the scene's top, or below another one. Returns its number.
  size_t add_moving_node(const std::string& name, size_t mesh, const glm::dvec3& translation,
                         std::optional<size_t> parent = {});
  /// Moves such a node, in the one animation of the file. path: "translation", "rotation" (quaternions, x y z
  /// w) or "scale"; values: of each key, one after the other. Even speed between keys.
  void animate(size_t node, const std::string& path, const std::vector<float>& times,
               const std::vector<float>& values);
  /// A light that shines from a point in all directions (KHR_lights_punctual): candela, and a colour in
  /// linear light. Returns its number.
  size_t add_point_light(const std::string& name, const glm::dvec3& colour, double candela);
  /// Places it: a node at the scene's top, or below another node.
  void add_light_node(size_t light, const glm::dvec3& position, std::optional<size_t> parent = {});
  /// Goes into `asset`: `copyright` and `extras`.
  void set_attribution(const std::string& copyright, nlohmann::ordered_json extras);
  void finish();

 private:
  size_t add_accessor(std::span<const std::byte> bytes, size_t count, bool indices);
  void add_node(nlohmann::ordered_json node, std::optional<size_t> parent);
  nlohmann::ordered_json add_primitive(const MeshPart& part);
  size_t material(const MeshPart& part);
  size_t texture(const std::string& image);

  std::filesystem::path folder_;
  std::string name_;
  AtomicFile buffer_;
  nlohmann::ordered_json gltf_;
  using Key = std::pair<std::array<uint32_t, 8>, std::array<std::string, 2>>;
  std::map<Key, size_t> materials_;
  std::map<std::string, size_t> textures_;
};

}  // namespace triptych
