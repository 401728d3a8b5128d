// Triangle lists, strips and fans over a table of vertices, as a stream: the buffers of glTF.
#pragma once

#include "model/import/mesh_stream_positions.hpp"
#include "model/mesh_stream.hpp"

#include <atomic>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// Vertex numbers at a stride, of an unsigned type.
struct IndexTable {
  std::shared_ptr<const StreamSource> source;
  uint64_t offset = 0, count = 0;
  size_t stride = 0;
  ScalarType type = ScalarType::uint32;
};

enum class TriangleMode : uint8_t { list, strip, fan };

struct IndexedPart {
  uint64_t vertex_count = 0;
  std::optional<IndexTable> indices;  ///< nullopt: every vertex in turn
  TriangleMode mode = TriangleMode::list;
  uint32_t material = 0;
  std::string place;  ///< of errors

  uint64_t index_count() const { return indices ? indices->count : vertex_count; }
  uint64_t triangle_count() const;
};

/// The triangles of a part as vertex numbers, one after the other; strips keep their winding.
class IndexedTriangles {
 public:
  explicit IndexedTriangles(const IndexedPart& part);
  /// False at the end. Error (place) for a number out of range.
  bool next(std::array<uint32_t, 3>& corners);

 private:
  bool next_index(uint32_t& index) {
    if (at_ == block_.size() && !refill()) return false;
    index = block_[at_++];
    return true;
  }
  bool refill();

  const IndexedPart& part_;
  std::optional<SourceWindow> window_;
  std::vector<uint32_t> block_;
  size_t at_ = 0;
  uint64_t done_ = 0;  ///< numbers in this block and those before
  uint64_t taken_ = 0;
  std::array<uint32_t, 2> before_{};
};

class IndexedStream : public MeshStream {
 public:
  struct Part {
    IndexedPart triangles;
    PositionTable positions;
    std::optional<ColorTable> colors = std::nullopt;            ///< of the same vertices
    std::optional<PositionTable> normals = std::nullopt;        ///< of the same vertices
    std::optional<CoordinateTable> coordinates = std::nullopt;  ///< of the same vertices
  };
  explicit IndexedStream(std::vector<Part> parts) : parts_(std::move(parts)) {}

  uint64_t triangle_count() const override;
  bool has_colors() const override;
  bool has_normals() const override;
  bool has_coordinates() const override;
  uint64_t read(const TakeTriangles& take) const override;
  std::vector<std::string> warnings() const override;

 private:
  std::vector<Part> parts_;
  mutable std::atomic<uint64_t> dropped_{0};
};

}  // namespace triptych
