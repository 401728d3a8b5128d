#include "model/import/mesh_stream_indexed.hpp"

#include "model/import/mesh_stream_batch.hpp"

#include <algorithm>
#include <cstring>

namespace triptych {

namespace {

constexpr uint64_t block_indices = 4096;

template <typename Value>
void load_indices(const std::byte* bytes, std::vector<uint32_t>& indices) {
  for (size_t i = 0; i < indices.size(); ++i) {
    Value value;
    std::memcpy(&value, bytes + i * sizeof(Value), sizeof(Value));
    indices[i] = value;
  }
}

void load_indices(const std::byte* bytes, ScalarType type, std::vector<uint32_t>& indices) {
  if (type == ScalarType::uint8) return load_indices<uint8_t>(bytes, indices);
  if (type == ScalarType::uint16) return load_indices<uint16_t>(bytes, indices);
  load_indices<uint32_t>(bytes, indices);
}

uint64_t end_of(const IndexTable& table) {
  return table.offset + (table.count == 0 ? 0 : (table.count - 1) * table.stride + scalar_bytes(table.type));
}

}  // namespace

uint64_t IndexedPart::triangle_count() const {
  const uint64_t count = index_count();
  if (mode == TriangleMode::list) return count / 3;
  return count < 3 ? 0 : count - 2;
}

IndexedTriangles::IndexedTriangles(const IndexedPart& part) : part_(part) {
  if (part.indices) window_.emplace(part.indices->source, part.indices->offset, end_of(*part.indices));
}

bool IndexedTriangles::refill() {
  const uint64_t count = std::min(block_indices, part_.index_count() - done_);
  block_.resize(count);
  at_ = 0;
  if (!window_) {
    for (uint64_t i = 0; i < count; ++i) block_[i] = static_cast<uint32_t>(done_ + i);
  } else {
    const size_t element = scalar_bytes(part_.indices->type), stride = part_.indices->stride;
    if (stride == element) {
      load_indices(window_->take(count * element), part_.indices->type, block_);
    } else {
      for (uint32_t& index : block_) {
        const std::byte* bytes = window_->take(std::min<uint64_t>(stride, window_->left()));
        index = static_cast<uint32_t>(load_scalar(bytes, part_.indices->type, false));
      }
    }
    for (uint64_t i = 0; i < count; ++i) {
      if (block_[i] >= part_.vertex_count)
        fail(part_.place, "index {} names vertex {} of {}", done_ + i, block_[i], part_.vertex_count);
    }
  }
  done_ += count;
  return count > 0;
}

bool IndexedTriangles::next(std::array<uint32_t, 3>& corners) {
  if (part_.mode == TriangleMode::list)
    return next_index(corners[0]) && next_index(corners[1]) && next_index(corners[2]);
  if (taken_ == 0) {
    if (!next_index(before_[0]) || !next_index(before_[1])) return false;
    taken_ = 2;
  }
  uint32_t last = 0;
  if (!next_index(last)) return false;
  const bool odd = taken_ % 2 == 1;
  ++taken_;
  if (part_.mode == TriangleMode::fan) {
    corners = {before_[0], before_[1], last};
    before_[1] = last;
  } else {
    corners = {before_[odd], before_[!odd], last};
    before_ = {before_[1], last};
  }
  return true;
}

uint64_t IndexedStream::triangle_count() const {
  uint64_t count = 0;
  for (const Part& part : parts_) count += part.triangles.triangle_count();
  return count;
}

bool IndexedStream::has_colors() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.colors.has_value(); });
}

bool IndexedStream::has_normals() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.normals.has_value(); });
}

bool IndexedStream::has_coordinates() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const Part& part) { return part.coordinates.has_value(); });
}

uint64_t IndexedStream::read(const TakeTriangles& take) const {
  TriangleBatch batch(take);
  for (const Part& part : parts_) {
    PositionCache positions(part.positions);
    std::optional<ColorCache> colors;
    if (part.colors) colors.emplace(*part.colors);
    std::optional<NormalCache> normals;
    if (part.normals) normals.emplace(*part.normals);
    std::optional<CoordinateCache> coordinates;
    if (part.coordinates) coordinates.emplace(*part.coordinates);
    IndexedTriangles triangles(part.triangles);
    for (std::array<uint32_t, 3> corners; triangles.next(corners);) {
      batch.add(positions.at(corners[0]), positions.at(corners[1]), positions.at(corners[2]),
                part.triangles.material,
                colors ? CornerColors{colors->at(corners[0]), colors->at(corners[1]), colors->at(corners[2])}
                       : CornerColors{},
                corner_normals_of(normals, corners),
                coordinates ? CornerCoordinates{coordinates->at(corners[0]), coordinates->at(corners[1]),
                                                coordinates->at(corners[2])}
                            : CornerCoordinates{});
    }
  }
  return dropped_ = batch.finish();
}

std::vector<std::string> IndexedStream::warnings() const {
  if (parts_.empty()) return {};
  return counted_warnings(parts_.front().triangles.place, {{dropped_, not_finite_warning}});
}

}  // namespace triptych
