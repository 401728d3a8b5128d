#include "residency/take.hpp"

#include "base/notice.hpp"

namespace triptych {

std::optional<Chunk> take(Residency& residency, uint32_t chunk, const MissingChunks& missing,
                          ChunkCache& cache) {
  if (cache.is_damaged(chunk)) return std::nullopt;
  try {
    return missing.wait ? residency.take(chunk) : residency.take_if_ready(chunk);
  } catch (const Error& error) {
    if (missing.fail) throw;
    cache.mark_damaged(chunk);
    say_damaged(error.what());
    return std::nullopt;
  }
}

std::vector<Texel> take_texels(Residency& residency, const Texture& texture, uint32_t index, uint32_t level,
                               const MissingChunks& missing) {
  try {
    return residency.read_texels(index, level);
  } catch (const Error& error) {
    if (missing.fail) throw;
    notice("{}: what it is on is drawn without it", error.what());
    const size_t count = size_t{side_at_level(texture.width, level)} * side_at_level(texture.height, level);
    return std::vector<Texel>(count, Texel{255, 255, 255, 255});
  }
}

void say_damaged(const std::string& damage) {
  notice("{}: what is coarser is drawn in its place, where there is any", damage);
}

}  // namespace triptych
