#include "measure/side_by_side.hpp"

#include "base/hashing.hpp"
#include "base/progress.hpp"
#include "base/signals.hpp"

#include <memory>

namespace triptych {

std::vector<SideBySideRun> run_side_by_side(std::span<const Pack* const> packs,
                                            const std::vector<FrameRequest>& requests,
                                            const DeviceOptions& device, size_t rounds) {
  std::vector<SideBySideRun> runs(packs.size());
  if (requests.empty()) return runs;
  {
    const View& first = requests.front().state.view;
    std::vector<std::unique_ptr<LocalPipeline>> fallbacks;
    for (const Pack* pack : packs) {
      fallbacks.push_back(std::make_unique<LocalPipeline>(
          *pack, LocalPipelineOptions{.width = first.width, .height = first.height, .device = device}));
    }
    Progress progress("side by side", rounds * requests.size());
    for (size_t round = 0; round < rounds; ++round) {
      for (const auto& fallback : fallbacks) fallback->forget();
      for (size_t frame = 0; frame < requests.size(); ++frame) {
        for (size_t turn = 0; turn < packs.size(); ++turn) {
          const size_t which = (turn + frame + round) % packs.size();
          FrameRecord record = fallbacks[which]->draw(requests[frame]);
          if (round == 0) {
            const std::vector<uint8_t> colors = fallbacks[which]->target().read_colors();
            record.picture_hash = hash_values(std::span<const uint8_t>(colors));
          }
          runs[which].frames.push_back(std::move(record));
        }
        progress.advance();
        end_if_asked("side by side");
      }
    }
  }
  for (size_t i = 0; i < packs.size(); ++i) {
    const std::vector<FrameRecord> first_round(
        runs[i].frames.begin(), runs[i].frames.begin() + static_cast<std::ptrdiff_t>(requests.size()));
    runs[i].comparison = compare(*packs[i], device, requests, {&first_round}).front();
  }
  return runs;
}

}  // namespace triptych
