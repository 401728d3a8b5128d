#include "model/import/mesh_stream_positions.hpp"

#include "model/import/display_color.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <new>
#include <sys/mman.h>

namespace triptych {

namespace {

constexpr size_t min_blocks = 256, slab_bytes = size_t{1} << 20;
/// Of all caches of the process together; 64 MiB unless limit_all() changes it.
std::atomic<uint64_t> blocks_taken{0}, max_blocks{10922};

template <typename Value>
double load(const std::byte* bytes, bool swapped) {
  std::array<std::byte, sizeof(Value)> copy;
  std::memcpy(copy.data(), bytes, sizeof(Value));
  if (swapped) std::reverse(copy.begin(), copy.end());
  Value value;
  std::memcpy(&value, copy.data(), sizeof(Value));
  return static_cast<double>(value);
}

double largest_of(ScalarType type) {
  constexpr std::array<double, 8> largest = {127, 255, 32767, 65535, 2147483647, 4294967295, 1, 1};
  return largest[static_cast<size_t>(type)];
}

double load_plain(const std::byte* bytes, ScalarType type, bool swapped) {
  switch (type) {
    case ScalarType::int8:
      return load<int8_t>(bytes, false);
    case ScalarType::uint8:
      return load<uint8_t>(bytes, false);
    case ScalarType::int16:
      return load<int16_t>(bytes, swapped);
    case ScalarType::uint16:
      return load<uint16_t>(bytes, swapped);
    case ScalarType::int32:
      return load<int32_t>(bytes, swapped);
    case ScalarType::uint32:
      return load<uint32_t>(bytes, swapped);
    case ScalarType::float32:
      return load<float>(bytes, swapped);
    case ScalarType::float64:
      return load<double>(bytes, swapped);
  }
  return 0;
}

}  // namespace

double load_scalar(const std::byte* bytes, ScalarType type, bool swapped, bool normalized) {
  const double value = load_plain(bytes, type, swapped);
  return normalized ? std::max(value / largest_of(type), -1.0) : value;
}

uint64_t PositionTable::bytes() const {
  size_t last = 0;
  for (const Field& field : fields) last = std::max(last, field.at + scalar_bytes(field.type));
  return count == 0 ? 0 : (count - 1) * stride + last;
}

void PositionTable::check() const {
  if (offset > source->size() || bytes() > source->size() - offset)
    fail(source->name(), "{} vertices go beyond the file", count);
}

PositionCache::PositionCache(const PositionTable& table) : table_(table), reader_(table.source) {
  table_.check();
}

void PositionCache::limit_all(uint64_t bytes) { max_blocks = bytes / block_bytes; }

PositionCache::~PositionCache() {
  blocks_taken -= slots_.size();
  for (void* slab : slabs_) ::munmap(slab, slab_bytes);
}

const glm::dvec3* PositionCache::find(uint64_t block) {
  const auto known = slot_of_.find(block);
  size_t slot = 0;
  if (known != slot_of_.end()) {
    slot = known->second;
  } else {
    slot = free_slot();
    read(block, slots_[slot].positions);
    slots_[slot].block = block;
    slot_of_[block] = slot;
  }
  slots_[slot].used = true;
  recent_[block % recent_.size()] = {block, slots_[slot].positions};
  return slots_[slot].positions;
}

size_t PositionCache::free_slot() {
  if (slots_.size() < min_blocks || blocks_taken.load() < max_blocks.load()) {
    slots_.push_back({.positions = new_block()});
    ++blocks_taken;
    return slots_.size() - 1;
  }
  // The clock algorithm (second chance): blocks that were used since the hand passed are kept.
  while (slots_[hand_].used) {
    slots_[hand_].used = false;
    hand_ = (hand_ + 1) % slots_.size();
  }
  const size_t slot = hand_;
  hand_ = (hand_ + 1) % slots_.size();
  const uint64_t block = slots_[slot].block;
  if (block != no_block) {
    slot_of_.erase(block);
    Recent& recent = recent_[block % recent_.size()];
    if (recent.block == block) recent = {};
    slots_[slot].block = no_block;
  }
  return slot;
}

glm::dvec3* PositionCache::new_block() {
  constexpr size_t slab_blocks = slab_bytes / block_bytes;
  const size_t place = slots_.size() % slab_blocks;
  if (place == 0) {
    void* slab = ::mmap(nullptr, slab_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (slab == MAP_FAILED) throw std::bad_alloc();
    slabs_.push_back(slab);
  }
  return reinterpret_cast<glm::dvec3*>(static_cast<std::byte*>(slabs_.back()) + place * block_bytes);
}

void PositionCache::read(uint64_t block, glm::dvec3* positions) {
  PositionTable part = table_;
  part.offset = table_.offset + block * block_positions * table_.stride;
  part.count = std::min(block_positions, table_.count - block * block_positions);
  raw_.resize(part.bytes());
  reader_.read(part.offset, raw_);
  const auto& fields = table_.fields;
  const bool plain = !table_.swapped && !table_.normalized && fields[1].at == fields[0].at + 4 &&
                     fields[2].at == fields[0].at + 8 &&
                     std::all_of(fields.begin(), fields.end(),
                                 [](const auto& field) { return field.type == ScalarType::float32; });
  const std::byte* record = raw_.data();
  for (uint64_t i = 0; i < part.count; ++i, record += table_.stride) {
    if (plain) {
      std::array<float, 3> values;
      std::memcpy(values.data(), record + fields[0].at, sizeof(values));
      positions[i] = {values[0], values[1], values[2]};
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const auto& field = fields[static_cast<size_t>(axis)];
      positions[i][axis] = load_scalar(record + field.at, field.type, table_.swapped, table_.normalized);
    }
  }
}

VertexColor ColorCache::at(uint64_t index) {
  const glm::dvec3 color(glm::vec3(values_.at(index) * scale_));  // as MeshSpool keeps them
  return linear_ ? vertex_color_of_linear(color) : vertex_color(color);
}

TextureCoordinates CoordinateCache::at(uint64_t index) {
  const glm::dvec3 own = values_.at(index);
  return texture_coordinates(to_[0] * own.x + to_[1] * own.y + to_[2],
                             to_[3] * own.x + to_[4] * own.y + to_[5]);
}

}  // namespace triptych
