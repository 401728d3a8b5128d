// The viewpoints of a BCF file as frames.
#pragma once

#include "session/first_viewpoint.hpp"
#include "session/run_options.hpp"
#include "view/viewer.hpp"

#include <filesystem>
#include <vector>

namespace triptych {

/// Each viewpoint as a frame of that size and quality; --frames and --every count. What cannot be shown is
/// said. Error for a file that cannot be used (read_bcf()).
std::vector<FrameRequest> viewpoint_frames(const std::filesystem::path& bcf, const RunOptions& options,
                                           const Pack& pack);

/// A viewer that begins at a viewpoint, if there is to be one. What cannot be shown is said if `says`. Error
/// where it is not there.
void begin_at_viewpoint(const FirstViewpoint& first, const Pack& pack, ViewerOptions& options,
                        bool says = true);

}  // namespace triptych
