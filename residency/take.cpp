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

void say_damaged(const std::string& damage) {
  notice("{}: what is coarser is drawn in its place, where there is any", damage);
}

}  // namespace triptych
