// Collects the vertices and faces of a file that cannot be streamed into meshes.
#pragma once

#include "base/descriptor.hpp"
#include "model/import/import_file.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace triptych {

class StreamSource;

/// Bytes that are appended: in memory at first, then in a temporary file that was unlinked, so that nothing
/// is left of it however the program ends.
class ByteSpool {
 public:
  void append(std::span<const std::byte> bytes);
  uint64_t size() const { return written_ + buffer_.size(); }
  /// Moves all bytes, and those that follow, to a file in the folder. Error (folder) if that fails.
  void move_to_file(const std::filesystem::path& folder);
  /// The bytes in memory: all of them before move_to_file.
  std::span<const std::byte> bytes() const { return buffer_; }
  /// Returns the file, under the name that errors and warnings use; nothing may be appended after that.
  std::shared_ptr<const StreamSource> take_file(const std::string& name);

 private:
  void flush();
  std::string name_;
  Descriptor file_;
  uint64_t written_ = 0;
  std::vector<std::byte> buffer_;
};

/// Takes vertices and faces in any order, and places the meshes in the end: in memory where they are few, at
/// most 262,144 triangles and vertices and what is left of ImportOptions::max_in_memory, otherwise as
/// streams of a temporary file.
class MeshSpool {
 public:
  explicit MeshSpool(FileImport& target) : target_(target) {}

  void add_vertex(const glm::dvec3& position);
  uint64_t vertex_count() const { return vertices_.size() / sizeof(glm::dvec3); }
  /// The faces that follow belong to a mesh of this name; a mesh without faces is dropped.
  void begin_mesh(std::string name);
  /// The corners' vertices may be added later. Fewer than three corners are skipped and counted.
  void add_face(std::span<const uint32_t> corners, uint32_t material);
  /// Places the meshes. Every vertex that a face names must have been added.
  void finish();

 private:
  struct Part {
    std::string name;
    uint64_t begin = 0;  ///< byte of the first face
    uint64_t faces = 0, end = 0;
  };
  /// Continues in a file if there is this much.
  void grow_beyond(uint64_t triangles_or_vertices);
  void place_in_memory();
  void place_streams();

  FileImport& target_;
  ByteSpool vertices_;  ///< three doubles each
  ByteSpool faces_;     ///< material, number of corners, corners: 32 bits each
  std::vector<Part> parts_;
  uint64_t triangles_ = 0;
  bool in_file_ = false;
};

}  // namespace triptych
