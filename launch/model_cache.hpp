// Packs that the program builds by itself of model files, kept from run to run.
#pragma once

#include "launch/build_flags.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace triptych {

/// TRIPTYCH_CACHE, or triptych/ in XDG_CACHE_HOME or ~/.cache. Error where none of these is set.
std::filesystem::path cache_folder();

/// The pack of these models with these flags: the one in the cache where there is one, else it is built into
/// it first, by a process of its own that says how far it is. What decides is what is in the models' files,
/// in those that they name and in those that their readers opened besides, the flags and the program itself;
/// not where the files lie. Processes that want the same pack at the same time wait for the one that builds
/// it; a build that was killed is resumed. When one is built, others leave the cache as make_room() says
/// (launch/cache_room.hpp); none that this process was given, as long as it lives. Error of the build, and
/// for files that change meanwhile.
std::filesystem::path cached_pack(const BuildFlags& flags, std::optional<uint64_t> limit);

}  // namespace triptych
