#include "visibility/cut_bodies.hpp"

#include <algorithm>
#include <tuple>

namespace triptych {

void CutBodies::find(const FrameView& view, std::span<const DrawItem> items) {
  bodies_.clear();
  runs_.clear();
  shown_.clear();
  if (view.section_space.keeps_all()) return;
  const ClosedSurfaces& closed = skeleton_.closed;
  for (uint32_t i = 0; i < items.size(); ++i) {
    const DrawItem& item = items[i];
    const uint32_t alone = closed.in_chunk(item.chunk);
    const SectionPlace place = alone > 0 ? view.section_place(item.pieces) : SectionPlace();
    if (!place.outside && !place.inside()) {
      bodies_.push_back({item.transform, place.cut, static_cast<uint32_t>(runs_.size()), 1});
      runs_.push_back({item.chunk, 0, alone, i});
    }
    for (const uint32_t run : closed.runs_in(item.chunk))
      shown_.push_back({closed.runs[run].body, item.transform, run, i});
  }
  std::ranges::sort(shown_, {},
                    [](const Shown& s) { return std::tuple(s.body, s.transform, s.run, s.item); });
  for (auto first = shown_.begin(); first != shown_.end();) {
    const auto last = std::find_if(first, shown_.end(), [&](const Shown& s) {
      return s.body != first->body || s.transform != first->transform;
    });
    add_divided(view, {first, last});
    first = last;
  }
}

void CutBodies::add_divided(const FrameView& view, std::span<const Shown> shown) {
  const ClosedSurfaces& closed = skeleton_.closed;
  const DividedBody& body = closed.bodies[shown.front().body];
  const uint32_t transform = shown.front().transform;
  const SectionPlace place = view.section_place(placed_body(skeleton_, body, view.transform(transform)));
  if (place.outside || place.inside()) return;
  bodies_.push_back({transform, place.cut, static_cast<uint32_t>(runs_.size()), body.run_count});
  for (uint32_t run = body.first_run; run < body.first_run + body.run_count; ++run) {
    // Where a chunk is drawn twice at one place, the first one has the cap.
    while (!shown.empty() && shown.front().run < run) shown = shown.subspan(1);
    const bool drawn = !shown.empty() && shown.front().run == run;
    const ClosedRun& of = closed.runs[run];
    runs_.push_back({of.chunk, of.first_triangle, of.triangle_count, drawn ? shown.front().item : no_id});
  }
}

}  // namespace triptych
