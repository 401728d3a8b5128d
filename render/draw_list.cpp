#include "render/draw_list.hpp"

#include <algorithm>

namespace triptych {

void DrawList::clear() {
  records.clear();
  bounds.clear();
  commands.clear();
  triangles = 0;
}

void DrawListBuilder::begin(const FrameView& view) {
  placer_.begin(view);
  projector_.emplace(view);
}

void DrawListBuilder::append(std::span<const ChunkRange> ranges, std::span<const DrawItem> items,
                             DrawList& list) {
  for (const DrawItem& item : items) {
    const ChunkRange& range = ranges[item.chunk];
    if (!range.loaded()) continue;
    const PlacedLattice placed = placer_.place(item.transform, skeleton_.chunks[item.chunk].lattice);
    list.commands.push_back({.index_count = item.index_count,
                             .instance_count = 1,
                             .first_index = range.first_index + item.first_index,
                             .base_vertex = static_cast<int32_t>(range.base_vertex),
                             .base_instance = static_cast<uint32_t>(list.records.size())});
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
