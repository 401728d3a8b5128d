// The JSON of a glTF file as values. Only what is drawn is read: skins' weights, cameras and unknown
// extensions can be of any form. Numbers are as the file gives them, references are not checked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace triptych {

enum GltfComponent : int {
  gltf_byte = 5120,
  gltf_unsigned_byte = 5121,
  gltf_short = 5122,
  gltf_unsigned_short = 5123,
  gltf_int = 5124,
  gltf_unsigned_int = 5125,
  gltf_float = 5126,
  gltf_double = 5130
};

/// EXT_meshopt_compression of a buffer view.
struct GltfMeshopt {
  int64_t buffer = -1;
  uint64_t offset = 0, length = 0, stride = 0, count = 0;
  std::string mode, filter;
};

struct GltfView {
  int64_t buffer = -1;
  uint64_t offset = 0, length = 0, stride = 0;
  std::optional<GltfMeshopt> meshopt;
};

struct GltfSparse {
  uint64_t count = 0;
  int64_t indices_view = -1, values_view = -1;
  uint64_t indices_offset = 0, values_offset = 0;
  int indices_type = 0;
};

struct GltfAccessorEntry {
  int64_t view = -1;
  uint64_t offset = 0, count = 0;
  int component_type = 0;
  std::string type;  ///< "SCALAR", "VEC3" ...
  bool normalized = false;
  std::optional<GltfSparse> sparse;
};

/// KHR_draco_mesh_compression of a primitive.
struct GltfDraco {
  int64_t view = -1;
  int64_t positions = -1;                          ///< the id of Draco's attribute
  int64_t colors = -1;                             ///< the same of COLOR_0
  int64_t normals = -1;                            ///< the same of NORMAL
  std::map<std::string, int64_t> attributes = {};  ///< of all
};

struct GltfPrimitive {
  std::map<std::string, int64_t> attributes;  ///< accessors
  int64_t indices = -1, material = -1, mode = 4;
  bool has_targets = false;
  std::optional<GltfDraco> draco;
};

struct GltfMesh {
  std::string name;
  std::vector<GltfPrimitive> primitives;
};

struct GltfNode {
  std::string name;
  /// Members of "extras" that are texts, numbers or truth values, as texts.
  std::vector<std::pair<std::string, std::string>> extras;
  int64_t mesh = -1, skin = -1, light = -1;
  std::vector<int64_t> children;
  std::vector<double> matrix, translation, rotation, scale;  ///< empty where they are not given
  bool visible = true;                                       ///< KHR_node_visibility
  /// EXT_mesh_gpu_instancing: accessors.
  std::optional<std::map<std::string, int64_t>> instancing;
};

/// KHR_lights_punctual.
struct GltfLight {
  std::string type;
  std::array<double, 3> color = {1, 1, 1};
  double intensity = 1, range = 0;                          ///< range: 0 for none
  double inner_angle = 0, outer_angle = 0.785398163397448;  ///< of a spot, radians
};

struct GltfSkin {
  std::vector<int64_t> joints;
  int64_t inverse_bind_matrices = -1;
};

/// KHR_texture_transform: what texture coordinates are multiplied by, turned by, and moved by.
struct GltfTextureTransform {
  std::array<double, 2> offset = {0, 0}, scale = {1, 1};
  double rotation = 0;
  bool operator==(const GltfTextureTransform&) const = default;
};

/// A material's use of a texture.
struct GltfTextureUse {
  int64_t texture = -1;  ///< none
  int64_t coordinates = 0;
  GltfTextureTransform transform;
};

struct GltfTexture {
  int64_t image = -1, sampler = -1;
};

struct GltfSampler {
  int64_t wrap_u = 10497, wrap_v = 10497, magnify = 9729;
};

struct GltfAnimationSampler {
  int64_t input = -1, output = -1;  ///< accessors
  std::string interpolation = "LINEAR";
};

struct GltfAnimationChannel {
  int64_t sampler = -1, node = -1;
  std::string path;  ///< "translation", "rotation", "scale", "weights", or of an extension
};

struct GltfAnimation {
  std::vector<GltfAnimationChannel> channels;
  std::vector<GltfAnimationSampler> samplers;
};

enum class GltfAlpha : uint8_t { opaque, mask, blend };

struct GltfMaterial {
  std::array<double, 4> base_color = {1, 1, 1, 1};  ///< diffuse of specular-glossiness
  std::array<double, 3> emission = {0, 0, 0};       ///< of a strength beyond 1, too
  GltfTextureUse base, emissive;
  GltfAlpha alpha = GltfAlpha::opaque;
  double cutoff = 0.5;
};

struct GltfDocument {
  std::string version;
  std::vector<GltfView> views;
  std::vector<GltfAccessorEntry> accessors;
  std::vector<GltfMaterial> materials;
  std::vector<GltfTexture> textures;
  std::vector<GltfSampler> samplers;
  std::vector<GltfMesh> meshes;
  std::vector<GltfNode> nodes;
  std::vector<GltfSkin> skins;
  std::vector<GltfLight> lights;
  std::vector<std::vector<int64_t>> scenes;  ///< root nodes
  int64_t default_scene = -1;
  std::vector<std::string> required_extensions;
  std::vector<GltfAnimation> animations;
  /// Members of the wrong type, by what they are: they count as absent.
  std::map<std::string, uint64_t> misread;
};

/// Parses the text; nothing if it is not JSON. Names in another encoding than UTF-8 get question marks. Error
/// (place) if it is no object.
std::optional<GltfDocument> parse_gltf(const std::string& json, const std::string& place);

/// What is wrong with text that is not JSON (json_fault()), letters beyond ASCII aside.
std::string gltf_fault(const std::string& json);

}  // namespace triptych
