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

uint64_t texels_checksum(std::span<const Texture> textures) {
  std::vector<uint64_t> checksums;
  for (const Texture& texture : textures) {
    for (const TextureLevel& level : texture.levels) checksums.push_back(level.checksum);
  }
  return hash_values(std::span<const uint64_t>(checksums));
}

uint64_t instanced_content_hash(uint64_t skeleton_checksum, uint64_t sub_hierarchies_checksum) {
  const std::array checksums = {skeleton_checksum, sub_hierarchies_checksum};
  return hash_bytes(std::as_bytes(std::span(checksums)), instanced_pack_format_version);
}

}  // namespace triptych
