// Random access to the positions of a vertex table in a file, through a cache of decoded blocks.
#pragma once

#include "model/import/mesh_stream_source.hpp"
#include "scene/texture.hpp"
#include "scene/vertex_color.hpp"
#include "scene/vertex_normal.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <unordered_map>
#include <vector>

namespace triptych {

enum class ScalarType : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr size_t scalar_bytes(ScalarType type) {
  constexpr std::array<size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<size_t>(type)];
}

/// The value at a place, which need not be aligned. Every type fits a double exactly. Normalized integers
/// stand for −1..1 or 0..1.
double load_scalar(const std::byte* bytes, ScalarType type, bool swapped, bool normalized = false);

/// Records of one length, one per vertex, with three scalars somewhere in each.
struct PositionTable {
  struct Field {
    size_t at;  ///< byte within the record
    ScalarType type;
  };
  /// Tables of longer records cannot be streamed.
  static constexpr size_t max_stride = 8192;

  std::shared_ptr<const StreamSource> source;
  uint64_t offset = 0, count = 0;
  size_t stride = 0;
  std::array<Field, 3> fields{};
  bool swapped = false;     ///< in the other byte order
  bool normalized = false;  ///< integers stand for −1..1 or 0..1

  /// Bytes from the start of the first record to the last used byte of the last one.
  uint64_t bytes() const;
  /// Error (name) unless every record lies within the source.
  void check() const;
};

/// Reads positions by their number. Caches of all threads together hold at most what limit_all() allows: each
/// allocates blocks up to that, at least 1.5 MiB, then reuses its own. Vertices in the order of their use, as
/// in scans, are read sequentially. For one thread.
class PositionCache {
 public:
  explicit PositionCache(const PositionTable& table);
  /// For the rest of the process, or until the next call.
  static void limit_all(uint64_t bytes);
  ~PositionCache();
  PositionCache(const PositionCache&) = delete;
  PositionCache& operator=(const PositionCache&) = delete;

  uint64_t count() const { return table_.count; }
  /// index < count()
  glm::dvec3 at(uint64_t index) {
    const uint64_t block = index / block_positions;
    const Recent& recent = recent_[block % recent_.size()];
    const glm::dvec3* positions = recent.block == block ? recent.positions : find(block);
    return positions[index % block_positions];
  }

 private:
  static constexpr uint64_t block_positions = 256, no_block = ~uint64_t{0};
  static constexpr size_t block_bytes = block_positions * sizeof(glm::dvec3);
  /// The blocks used last: most look-ups end here.
  struct Recent {
    uint64_t block = no_block;
    const glm::dvec3* positions = nullptr;
  };
  struct Slot {
    uint64_t block = no_block;
    bool used = false;  ///< since the clock hand passed
    glm::dvec3* positions = nullptr;
  };
  const glm::dvec3* find(uint64_t block);
  size_t free_slot();
  glm::dvec3* new_block();
  void read(uint64_t block, glm::dvec3* positions);

  PositionTable table_;
  SourceReader reader_;
  std::array<Recent, 1024> recent_;
  std::unordered_map<uint64_t, size_t> slot_of_;
  std::vector<Slot> slots_;
  std::vector<void*> slabs_;  ///< memory from the kernel, all of which the destructor returns
  size_t hand_ = 0;
  std::vector<std::byte> raw_;
};

/// Colours of vertices in a file: red, green and blue in place of x, y and z.
struct ColorTable {
  PositionTable values;
  glm::dvec3 scale{1};  ///< what values are multiplied by to be from 0 to 1
  bool linear = false;  ///< linear light; otherwise as displayed
};

/// Reads colours by their number, as PositionCache does positions.
class ColorCache {
 public:
  explicit ColorCache(const ColorTable& table)
      : values_(table.values), scale_(table.scale), linear_(table.linear) {}
  VertexColor at(uint64_t index);

 private:
  PositionCache values_;
  glm::dvec3 scale_;
  bool linear_;
};

/// The same of normals: x, y and z of directions of any length.
class NormalCache {
 public:
  explicit NormalCache(const PositionTable& values) : values_(values) {}
  VertexNormal at(uint64_t index) {
    return to_vertex_normal(glm::dvec3(glm::vec3(values_.at(index))));  // as MeshSpool keeps them
  }

 private:
  PositionCache values_;
};

/// Of the corners of a triangle; of a table that is not there none.
template <typename Cache>
CornerNormals corner_normals_of(Cache& normals, const std::array<uint32_t, 3>& corners) {
  if (!normals) return {};
  return {normals->at(corners[0]), normals->at(corners[1]), normals->at(corners[2])};
}

/// Texture coordinates of vertices in a file: in place of x and y.
struct CoordinateTable {
  PositionTable values;
  /// What they are multiplied by: u = to[0] · x + to[1] · y + to[2], and so on.
  std::array<double, 6> to = {1, 0, 0, 0, 1, 0};
};

/// Reads them by their number, as PositionCache does positions.
class CoordinateCache {
 public:
  explicit CoordinateCache(const CoordinateTable& table) : values_(table.values), to_(table.to) {}
  TextureCoordinates at(uint64_t index);

 private:
  PositionCache values_;
  std::array<double, 6> to_;
};

}  // namespace triptych
