// What it took to draw within caps of memory.
#pragma once

#include "nodes/frame_record.hpp"
#include "nodes/memory_caps.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace triptych {

/// Of frames that a process drew, in order: adds {memory_cap, device_cap (null: none), geometry_cap (what
/// they left for geometry), peak_device_bytes, hits, misses, waits, wait_ms, evicted_chunks, reloaded_chunks,
/// bytes_read, reads (of the pack, each of one chunk or of several), bytes_uploaded, prefetch {precision,
/// recall}, raised_frames, raised_pixel_error_max, owing_frames, owed_drawables, redrawn_frames (of a
/// session: by the render node alone, since what was sent had no room), leaving_out_frames,
/// left_out_drawables, textures {cap, peak_bytes, hits, misses, evicted, bytes_read, bytes_decoded,
/// bytes_uploaded, coarser_frames (that showed coarser levels for want of room), over_cap_frames}}. Hits are
/// chunks that a frame used and that were there; misses, that had to come; waits, those of them that had not
/// been read ahead. Returns sentences for people.
std::string add_streaming(nlohmann::json& report, const std::vector<FrameRecord>& records,
                          const MemoryCaps& caps, const DrawingMemory& memory);

}  // namespace triptych
