// The inner seams of the glTF importer. tinygltf parses, without images; every range is checked here, it
// checks none.
#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include "scene/import_file.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tiny_gltf.h>
#include <vector>

namespace triptych {

/// Parses a .gltf or .glb file and loads its buffers. Error (file) for one that does not parse, lacks a
/// buffer, or requires an extension that is not known.
tinygltf::Model load_gltf(FileImport& target);

/// The elements of one accessor, sparse ones included. Construction checks every range (Error, place), so
/// that reading element 0 … count() − 1 never leaves the buffer.
class GltfAccessor {
 public:
  GltfAccessor(const tinygltf::Model& gltf, int accessor, const std::string& place);

  size_t count() const { return count_; }
  int components() const { return components_; }
  bool holds_indices() const;
  /// Component c of element i; normalized integers as −1..1 or 0..1.
  double component(size_t i, int c) const;
  uint32_t index(size_t i) const;

 private:
  const uint8_t* element(size_t i) const;
  size_t element_bytes() const;

  size_t count_ = 0, stride_ = 0, sparse_count_ = 0;
  int components_ = 0, component_type_ = 0;
  bool normalized_ = false;
  const uint8_t* data_ = nullptr;  ///< null where every element is zero
  const uint8_t* sparse_values_ = nullptr;
  std::vector<uint32_t> sparse_indices_;  ///< rising
};

/// Adds the meshes of the file to the target when they are asked for, each once.
class GltfMeshes {
 public:
  GltfMeshes(const tinygltf::Model& gltf, FileImport& target);
  /// The model's index of the file's mesh; nothing if it holds no triangles. Error for an index out of range.
  std::optional<uint32_t> mesh(int index, const std::string& place);
  size_t unused_count() const;

 private:
  std::optional<uint32_t> read_mesh(size_t index);
  void read_primitive(const tinygltf::Primitive& primitive, const std::string& place, Mesh& mesh);
  void read_material(const tinygltf::Material& material);

  const tinygltf::Model& gltf_;
  FileImport& target_;
  std::vector<uint32_t> materials_;              ///< the file's to the model's
  std::vector<bool> known_;                      ///< whether the mesh was asked for
  std::vector<std::optional<uint32_t>> meshes_;  ///< the file's to the model's
  std::vector<uint32_t> renamed_;  ///< an accessor's vertex to the mesh's, while a primitive is read
};

/// Walks the scene's node tree and places its meshes, EXT_mesh_gpu_instancing included. Error for nodes that
/// are out of range, have several parents or form a cycle.
void place_gltf_nodes(const tinygltf::Model& gltf, FileImport& target, GltfMeshes& meshes);

}  // namespace triptych
