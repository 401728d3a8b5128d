// The pack that a session had, named by its recording.
#pragma once

#include "protocol/recording.hpp"
#include "scene/pack.hpp"

#include <filesystem>

namespace triptych {

/// recording: its file, for errors. moved_to: where the pack is now; empty: where the session had it. Error
/// (recording) where it is not there, or is another one.
Pack open_recorded_pack(const std::filesystem::path& recording, const RecordingHeader& header,
                        const std::filesystem::path& moved_to);

}  // namespace triptych
