#include "render/draw_list.hpp"

#include "visibility/facing.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// Of one chunk: each takes a command, and most of them a change of state, which cost more than backs do.
constexpr size_t max_runs = 8;

}  // namespace

void DrawList::clear() {
  records.clear();
  bounds.clear();
  commands.clear();
  groups.clear();
  triangles = 0;
}

void DrawListBuilder::begin(const FrameView& view) {
  view_ = view;
  placer_.begin(view);
  projector_.emplace(view);
}

void DrawListBuilder::add_command(const ChunkRange& range, int32_t front, uint32_t first_triangle,
                                  uint32_t end, DrawList& list) {
  list.commands.push_back({.index_count = 3 * (end - first_triangle),
                           .instance_count = 1,
                           .first_index = range.first_index + 3 * first_triangle,
                           .base_vertex = static_cast<int32_t>(range.base_vertex),
                           .base_instance = static_cast<uint32_t>(list.records.size())});
  const DrawGroup group{front, range.colored, 0};
  if (list.groups.empty() || list.groups.back().front != front || list.groups.back().colored != range.colored)
    list.groups.push_back(group);
  ++list.groups.back().count;
}

void DrawListBuilder::append(std::span<const ChunkRange> ranges, std::span<const DrawItem> items,
                             DrawList& list) {
  for (const DrawItem& item : items) {
    const ChunkRange& range = ranges[item.chunk];
    if (!range.loaded()) continue;
    const PlacedLattice placed = placer_.place(item.transform, skeleton_.chunks[item.chunk].lattice);
    const bool few_runs = !range.outward_runs.empty() && range.outward_runs.size() <= max_runs;
    const int32_t front =
        !few_runs ? 0 : outward_front(*view_, skeleton_.transforms[item.transform], item.pieces);
    const uint32_t first = item.first_index / 3, end = first + item.index_count / 3;
    if (front == 0) {
      add_command(range, 0, first, end, list);
    } else {
      uint32_t begin = first;
      for (size_t run = 0; run <= range.outward_runs.size() && begin < end; ++run) {
        const uint32_t run_end =
            run < range.outward_runs.size() ? std::clamp(range.outward_runs[run], begin, end) : end;
        if (run_end > begin) add_command(range, run % 2 == 1 ? front : 0, begin, run_end, list);
        begin = run_end;
      }
    }
    DrawRecord record{};
    record.item = item.drawable;
    record.first_bound = static_cast<uint32_t>(list.bounds.size());
    record.cell = placed.cell;
    std::copy(std::begin(placed.rows), std::end(placed.rows), record.rows);
    list.records.push_back(record);
    for (const LatticeBox& box : item.pieces) list.bounds.push_back(projector_->pixel_bound(box));
    list.triangles += item.index_count / 3;
  }
}

}  // namespace triptych
