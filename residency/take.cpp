#include "residency/take.hpp"

#include "base/notice.hpp"

namespace triptych {

std::optional<Chunk> take(Residency& residency, uint32_t chunk, const MissingChunks& missing,
                          ChunkCache& cache) {
  if (missing.wait) return residency.take(chunk);
  if (cache.is_damaged(chunk)) return std::nullopt;
  try {
    return residency.take_if_ready(chunk);
  } catch (const Error& error) {
    cache.mark_damaged(chunk);
    notice("{}: what is coarser is drawn in its place", error.what());
    return std::nullopt;
  }
}

}  // namespace triptych
