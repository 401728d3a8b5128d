// How much the model cache may take, and what leaves it for that.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace triptych {

/// Removes from the cache what nobody has wanted for 60 days; then, as long as the rest takes more than
/// `limit` bytes, what was wanted the longest time ago, and says so. No limit: a tenth of the disk that the
/// folder is on. Never the entry `own`, nor one that a process builds, looks at or uses. What fails does no
/// harm.
void make_room(const std::filesystem::path& cache, std::optional<uint64_t> limit,
               const std::filesystem::path& own);

/// Until this process ends, make_room() of another one leaves the pack where it is.
void keep_in_use(const std::filesystem::path& pack);

}  // namespace triptych
