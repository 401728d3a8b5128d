// Writes one indexed mesh to a binary PLY file as it comes, in bounded memory.
#pragma once

#include "base/file.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>

namespace triptych {

/// Vertices go to the file, faces to a nameless temporary file beside it until finish() appends them. The
/// file appears under its name only when finish() is done. Little-endian; float x, y, z; faces as a list of
/// int behind a uchar.
class PlyWriter {
 public:
  /// Error if the file cannot be made.
  PlyWriter(const std::filesystem::path& path, const std::string& comment);
  ~PlyWriter();

  /// Error for more vertices than 31 bits can number, and if writing fails.
  void add_vertices(std::span<const glm::vec3> positions);
  /// Indices of vertices, counted from the file's first; they may come before their vertices.
  void add_faces(std::span<const std::array<uint32_t, 3>> faces);
  /// Error if a write fails: then there is no file.
  void finish();

  uint64_t vertices() const { return vertices_; }
  uint64_t faces() const { return faces_; }

 private:
  std::string header() const;
  [[noreturn]] void spool_failed() const;

  std::string place_, comment_;
  AtomicFile file_;
  std::FILE* spool_ = nullptr;
  uint64_t vertices_ = 0, faces_ = 0;
};

}  // namespace triptych
