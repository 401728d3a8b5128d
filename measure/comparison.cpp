#include "measure/comparison.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/hashing.hpp"
#include "base/progress.hpp"

namespace triptych {

double Comparison::culling_efficiency() const {
  return visible_drawables ? static_cast<double>(drawn_drawables) / static_cast<double>(visible_drawables) : 0;
}

namespace {
/// The drawables that own a pixel, ascending.
VisibleSet owners(std::vector<uint32_t> items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
  VisibleSet ids;
  for (const uint32_t item : items) {
    if (item > 0) ids.push_back(item - 1);
  }
  return ids;
}
}  // namespace

Comparison compare(const Pack& pack, const std::vector<FrameRequest>& requests, const std::vector<FrameRecord>& records) {
  if (records.size() > requests.size()) fail("comparison", "{} frames were drawn of {}", records.size(), requests.size());
  Comparison comparison;
  if (records.empty()) return comparison;
  Renderer renderer(pack);
  const View& first = requests.front().view;
  PictureStage pictures(renderer, first.width, first.height), items(renderer, first.width, first.height, TargetKind::item);
  Progress progress("compare with un-culled", records.size());
  for (size_t i = 0; i < records.size(); ++i) {
    const FrameRecord& record = records[i];
    const Cut cut = select_cut(pack.skeleton(), requests[i].view, requests[i].pixel_error);
    pictures.begin(requests[i].view);
    pictures.draw(cut.drawables);
    const std::vector<uint8_t> colors = pictures.target().read_colors();
    items.begin(requests[i].view);
    items.draw(cut.drawables);
    const VisibleSet truth = owners(items.target().read_items());
    const bool identical = hash_values(std::span<const uint8_t>(colors)) == record.picture_hash;
    ++comparison.frames_compared;
    comparison.identical_frames += identical;
    if (!identical) comparison.different.push_back(record.number);
    comparison.visible_drawables += truth.size();
    comparison.drawn_drawables += record.visible.size();
    comparison.missing_drawables += difference(record.visible, truth).added.size();
    progress.advance();
  }
  return comparison;
}

}  // namespace triptych
