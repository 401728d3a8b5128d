#include "visibility/visible_stream.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace triptych {

namespace {
FrameState with_nothing_hidden(FrameState state) {
  state.hiding = {};
  return state;
}
}  // namespace

VisibleStream::VisibleStream(const Skeleton& skeleton, FrameState state, const VisibleSet& previous)
    : view_(skeleton, with_nothing_hidden(std::move(state))), visible_(previous) {
  for (const DrawableId id : previous) undecided_.push_back(draw_rank(view_, id));
  std::sort(undecided_.begin(), undecided_.end());
}

std::vector<DrawableId> VisibleStream::take(const CullPacket& packet) {
  VisibleDelta known;
  std::set_intersection(packet.delta.removed.begin(), packet.delta.removed.end(), visible_.begin(),
                        visible_.end(), std::back_inserter(known.removed));
  for (const DrawableId id : packet.delta.added) {
    if (id < view_.skeleton->drawables.size() && !std::binary_search(visible_.begin(), visible_.end(), id)) {
      known.added.push_back(id);
    }
  }
  faults_ += packet.delta.size() - known.size();
  if (!apply_delta(known, visible_)) {
    faults_ += known.size();
    known = {};
  }

  std::erase_if(undecided_, [&](const DrawRank& rank) {
    return std::binary_search(known.removed.begin(), known.removed.end(), rank.id);
  });
  for (const DrawableId id : known.added) undecided_.push_back(draw_rank(view_, id));
  std::sort(undecided_.begin(), undecided_.end());
  const auto open = std::lower_bound(undecided_.begin(), undecided_.end(), packet.watermark);
  std::vector<DrawableId> decided;
  for (auto rank = undecided_.begin(); rank != open; ++rank) decided.push_back(rank->id);
  undecided_.erase(undecided_.begin(), open);
  return decided;
}

}  // namespace triptych
