#include "measure/comparison.hpp"

#include "base/error.hpp"
#include "base/hashing.hpp"
#include "base/progress.hpp"
#include "base/signals.hpp"
#include "lod/cut.hpp"
#include "nodes/injected_rules.hpp"
#include "nodes/pack_device.hpp"
#include "nodes/picture_stage.hpp"

#include <algorithm>

namespace triptych {

double Comparison::culling_efficiency() const {
  return visible_drawables ? static_cast<double>(drawn_drawables) / static_cast<double>(visible_drawables)
                           : 0;
}

namespace {
void add_frame(Comparison& comparison, const FrameRecord& record, uint64_t picture_hash,
               const VisibleSet& truth) {
  const bool identical = picture_hash == record.picture_hash;
  ++comparison.frames_compared;
  comparison.identical_frames += identical;
  if (!identical) comparison.different.push_back(record.number);
  comparison.visible_drawables += truth.size();
  comparison.drawn_drawables += record.visible.size();
  comparison.missing_drawables += difference(record.visible, truth).added.size();
}

}  // namespace

std::vector<Comparison> compare(const Pack& pack, const DeviceOptions& options,
                                const std::vector<FrameRequest>& requests,
                                const std::vector<const std::vector<FrameRecord>*>& runs) {
  std::vector<Comparison> comparisons(runs.size());
  size_t frames = 0;
  for (const std::vector<FrameRecord>* run : runs) frames = std::max(frames, run->size());
  if (frames > requests.size()) fail("comparison", "{} frames were drawn of {}", frames, requests.size());
  if (frames == 0) return comparisons;
  PackDevice device(pack, options);
  const View& first = requests.front().state.view;
  PictureStage pictures(device.device(), first.width, first.height, TargetKind::color_and_item);
  const FrameRules rules = injected_frame_rules();
  CutLister cuts;
  Progress progress("compare with un-culled", frames);
  for (size_t i = 0; i < frames; ++i) {
    const FrameView view(pack.skeleton(), requests[i].state, rules);
    pictures.begin(view);
    pictures.draw(cuts.list(view));
    const std::vector<uint8_t> colors = pictures.target().read_colors();
    const VisibleSet truth = owners(pictures.target(), requests[i].state.samples);
    const uint64_t hash = hash_values(std::span<const uint8_t>(colors));
    for (size_t run = 0; run < runs.size(); ++run) {
      if (i < runs[run]->size()) add_frame(comparisons[run], (*runs[run])[i], hash, truth);
    }
    progress.advance();
    end_if_asked("comparison");
  }
  return comparisons;
}

}  // namespace triptych
