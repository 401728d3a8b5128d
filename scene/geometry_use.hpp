// What a device's geometry takes of its memory.
#pragma once

#include "base/error.hpp"

#include <cstdint>
#include <limits>

namespace triptych {

inline constexpr uint64_t no_cap = std::numeric_limits<uint64_t>::max();

/// What drawing does about chunks that are not in device memory.
struct MissingChunks {
  bool wait = true;    ///< it reads them; if not, it leaves them out, and they are read meanwhile
  bool refuse = true;  ///< NoRoom where a view needs more than the cap; if not, what has no room is left out
  bool fail = true;    ///< damage is an Error; if not, it is said once, and what is damaged is left out
};

/// What a device's textures take, each level for itself, within their share of the cap.
struct TextureUse {
  uint64_t cap = no_cap;
  uint64_t bytes = 0, peak_bytes = 0;  ///< of device memory
  uint64_t hits = 0;                   ///< levels (on `gl`: textures) that a view used and that were there
  uint64_t misses = 0;                 ///< that had to come
  uint64_t evicted = 0;                ///< that went
  uint64_t read_bytes = 0;             ///< of the pack
  uint64_t decoded_bytes = 0;          ///< texels that were made of them
  uint64_t uploaded_bytes = 0;         ///< to the device's memory; on `cpu` none
  uint64_t coarser_views = 0;          ///< views that showed coarser levels for want of room
  uint64_t over_cap_views = 0;         ///< views that took more than the cap all the same
};

/// What a device's geometry takes, and what was done to keep it within its cap.
struct GeometryUse {
  uint64_t cap = no_cap;
  uint64_t bytes = 0, peak_bytes = 0;  ///< of device memory
  uint64_t view_bytes = 0;             ///< of what the current view has used so far
  uint64_t hits = 0;                   ///< chunks that a view used and that were there, each once a view
  uint64_t loaded_chunks = 0, evicted_chunks = 0;
  uint64_t left_out = 0;         ///< that draws had to do without, each time
  uint64_t no_room = 0;          ///< of those: for want of room
  uint64_t reloaded_chunks = 0;  ///< loaded ones that had been there before
  uint64_t read_bytes = 0;       ///< of the pack
  uint64_t uploaded_bytes = 0;   ///< as the device has them
  double wait_ms = 0;            ///< that drawing waited for chunks
  TextureUse textures = {};      ///< beside all that
};

/// What one view draws takes more device memory than the cap.
class NoRoom : public Error {
 public:
  NoRoom(uint64_t needed_bytes, uint64_t cap_bytes)
      : Error("geometry", fmt::format("what one frame draws takes {} MiB or more, and the cap is {:.1f} MiB",
                                      (needed_bytes >> 20) + 1, static_cast<double>(cap_bytes) / 0x1p20)),
        needed_(needed_bytes) {}
  /// At least, in bytes: what the view had used, and what was to come next.
  uint64_t needed() const { return needed_; }

 private:
  uint64_t needed_;
};

}  // namespace triptych
