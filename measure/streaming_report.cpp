#include "measure/streaming_report.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace triptych {

namespace {

using nlohmann::json;

json cap_json(uint64_t cap) { return cap == no_cap ? json() : json(cap); }

json share(uint64_t part, uint64_t whole) {
  return whole == 0 ? json() : json(static_cast<double>(part) / static_cast<double>(whole));
}

std::string percent(const json& share) {
  return share.is_null() ? "none" : fmt::format("{:.0f} %", 100 * share.get<double>());
}

json textures_json(const TextureUse& use) {
  return {{"cap", cap_json(use.cap)},
          {"peak_bytes", use.peak_bytes},
          {"hits", use.hits},
          {"misses", use.misses},
          {"evicted", use.evicted},
          {"bytes_read", use.read_bytes},
          {"bytes_decoded", use.decoded_bytes},
          {"bytes_uploaded", use.uploaded_bytes},
          {"coarser_frames", use.coarser_views},
          {"over_cap_frames", use.over_cap_views}};
}

std::string texture_words(const TextureUse& use) {
  if (use.misses == 0) return "";
  std::string words = fmt::format(
      "textures took {:.1f} MiB at most; {} levels or textures came ({:.1f} MiB of the pack, {:.1f} MiB "
      "decoded), and {} went\n",
      static_cast<double>(use.peak_bytes) / 0x1p20, use.misses, static_cast<double>(use.read_bytes) / 0x1p20,
      static_cast<double>(use.decoded_bytes) / 0x1p20, use.evicted);
  if (use.coarser_views > 0)
    words += fmt::format("{} frames showed coarser levels of textures for want of room\n", use.coarser_views);
  if (use.over_cap_views > 0)
    words += fmt::format("in {} frames textures took MORE than their share: more memory is needed\n",
                         use.over_cap_views);
  return words;
}

}  // namespace

std::string add_streaming(json& report, const std::vector<FrameRecord>& records, const MemoryCaps& caps,
                          const DrawingMemory& memory) {
  const GeometryUse& use = memory.geometry;
  const ReadAheadUse& ahead = memory.read_ahead;
  uint64_t raised = 0, owing = 0, owed = 0, leaving_out = 0, left_out = 0, redrawn = 0;
  double largest = 0;
  for (const FrameRecord& record : records) {
    raised += record.raised_for_memory;
    owing += record.owed_drawables > 0;
    owed += record.owed_drawables;
    redrawn += record.redrawn;
    leaving_out += record.left_out_drawables > 0;
    left_out += record.left_out_drawables;
    largest = std::max(largest, record.pixel_error);
  }
  const json prefetch = {{"precision", share(ahead.foreseen_taken, ahead.foreseen_read)},
                         {"recall", share(ahead.foreseen_taken, ahead.taken)}};
  report["memory_cap"] = cap_json(caps.memory);
  report["device_cap"] = cap_json(caps.device_memory);
  report["geometry_cap"] = cap_json(use.cap);
  report["peak_device_bytes"] = use.peak_bytes;
  report["hits"] = use.hits;
  report["misses"] = use.loaded_chunks;
  report["waits"] = use.loaded_chunks - std::min(use.loaded_chunks, ahead.in_time);
  report["wait_ms"] = use.wait_ms;
  report["evicted_chunks"] = use.evicted_chunks;
  report["reloaded_chunks"] = use.reloaded_chunks;
  report["bytes_read"] = use.read_bytes;
  report["bytes_uploaded"] = use.uploaded_bytes;
  report["textures"] = textures_json(use.textures);
  report["reads"] = ahead.reads;
  report["prefetch"] = prefetch;
  report["raised_frames"] = raised;
  report["owing_frames"] = owing;
  report["owed_drawables"] = owed;
  report["redrawn_frames"] = redrawn;
  report["leaving_out_frames"] = leaving_out;
  report["left_out_drawables"] = left_out;
  report["raised_pixel_error_max"] = largest;
  std::string words = fmt::format(
      "geometry took {:.1f} MiB at most; {} chunks came ({:.1f} MiB of the pack), {} of them not "
      "read ahead in time, and {} went\n",
      static_cast<double>(use.peak_bytes) / 0x1p20, use.loaded_chunks,
      static_cast<double>(use.read_bytes) / 0x1p20, report["waits"].get<uint64_t>(), use.evicted_chunks);
  words += texture_words(use.textures);
  if (ahead.foreseen_read > 0) {
    words += fmt::format("of what was read ahead {} was needed, of what was needed {} was read ahead\n",
                         percent(prefetch["precision"]), percent(prefetch["recall"]));
  }
  if (raised > 0) {
    words += fmt::format("{} of {} frames had no room: their pixel error was raised, to {:.2f} px at most\n",
                         raised, records.size(), largest);
  }
  if (owing > 0) {
    words +=
        fmt::format("{} of {} frames drew something coarser that was not read yet, {} drawables in all\n",
                    owing, records.size(), owed);
  }
  if (leaving_out > 0) {
    words += fmt::format(
        "{} of {} frames LEFT OUT what no pixel error gives room, as what a section cuts: {} drawables in "
        "all; more memory is needed\n",
        leaving_out, records.size(), left_out);
  }
  return words;
}

}  // namespace triptych
