#include "scene/pack_format.hpp"

#include "base/hashing.hpp"

#include <vector>

namespace triptych {

uint64_t geometry_checksum(std::span<const ChunkInfo> chunks) {
  std::vector<uint64_t> checksums;
  checksums.reserve(chunks.size());
  for (const ChunkInfo& chunk : chunks) checksums.push_back(chunk.checksum);
  return hash_values(std::span<const uint64_t>(checksums));
}

}  // namespace triptych
