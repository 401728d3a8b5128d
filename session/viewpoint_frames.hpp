// The viewpoints of a BCF file as frames.
#pragma once

#include "session/run_options.hpp"
#include "view/viewer.hpp"

#include <filesystem>
#include <vector>

namespace triptych {

/// Each viewpoint as a frame of that size and quality; --frames and --every count. What cannot be shown is
/// said. Error for a file that cannot be used (read_bcf()).
std::vector<FrameRequest> viewpoint_frames(const std::filesystem::path& bcf, const RunOptions& options,
                                           const Pack& pack);

/// A viewer that begins at the viewpoint of that number, counted from 1. Error where there is none.
void begin_at_viewpoint(const std::filesystem::path& bcf, size_t number, const Pack& pack,
                        ViewerOptions& options);

}  // namespace triptych
