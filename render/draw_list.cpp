#include "render/draw_list.hpp"

#include "visibility/facing.hpp"

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

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

/// Of the record that is added last.
void DrawListBuilder::add_command(const ChunkRange& range, const DrawGroup& group, uint32_t first_triangle,
                                  uint32_t end, DrawList& list) {
  if (end == first_triangle) return;
  list.commands.push_back({.index_count = 3 * (end - first_triangle),
                           .instance_count = 1,
                           .first_index = range.first_index + 3 * first_triangle,
                           .base_vertex = static_cast<int32_t>(range.base_vertex),
                           .base_instance = static_cast<uint32_t>(list.records.size() - 1)});
  const bool fits = !list.groups.empty() && group.caps == DrawGroup::Caps::none &&
                    list.groups.back().caps == DrawGroup::Caps::none &&
                    list.groups.back().front == group.front && list.groups.back().colored == group.colored;
  if (!fits) list.groups.push_back(group);
  ++list.groups.back().count;
}

/// Surfaces are closed together, so their winding numbers are counted together: first what is not outward,
/// and then all that is, as one group.
void DrawListBuilder::add_solid(const ChunkRange& range, bool mirrored, uint32_t first_triangle, uint32_t end,
                                DrawList& list) {
  const auto for_each_run = [&](bool outward, const auto& visit) {
    uint32_t begin = first_triangle;
    for (size_t run = 0; run <= range.outward_runs.size() && begin < end; ++run) {
      const uint32_t run_end =
          run < range.outward_runs.size() ? std::clamp(range.outward_runs[run], begin, end) : end;
      if (outward == (run % 2 == 1) && run_end > begin) visit(begin, run_end);
      begin = run_end;
    }
  };
  for_each_run(false, [&](uint32_t begin, uint32_t run_end) {
    add_command(range, {.colored = range.colored}, begin, run_end, list);
  });
  DrawRecord record = list.records.back();
  record.cut |= DrawRecord::outward | (mirrored ? DrawRecord::mirrored : 0);
  list.records.push_back(record);
  const DrawGroup solid{.colored = range.colored,
                        .caps = mirrored ? DrawGroup::Caps::mirrored : DrawGroup::Caps::plain};
  const size_t before = list.groups.size();
  for_each_run(true, [&](uint32_t begin, uint32_t run_end) {
    add_command(range, solid, begin, run_end, list);
    if (list.groups.size() <= before + 1) return;
    list.groups.pop_back();
    ++list.groups.back().count;
  });
}

void DrawListBuilder::append(std::span<const ChunkRange> ranges, std::span<const DrawItem> items,
                             DrawList& list) {
  for (const DrawItem& item : items) {
    const ChunkRange& range = ranges[item.chunk];
    if (!range.loaded()) continue;
    const SectionPlace place = view_->section_place(item.pieces);
    if (place.outside) continue;
    const PlacedLattice placed = placer_.place(item.transform, skeleton_.chunks[item.chunk].lattice);
    const bool few_runs = !range.outward_runs.empty() && range.outward_runs.size() <= max_runs;
    const int32_t front =
        !few_runs ? 0 : outward_front(*view_, skeleton_.transforms[item.transform], item.pieces);
    const uint32_t first = item.first_index / 3, end = first + item.index_count / 3;
    DrawRecord record{};
    record.item = item.drawable;
    record.first_bound = static_cast<uint32_t>(list.bounds.size());
    record.cell = placed.cell;
    std::copy(std::begin(placed.rows), std::end(placed.rows), record.rows);
    record.cut = place.cut;
    list.records.push_back(record);
    if (!place.inside() && !range.outward_runs.empty()) {
      const bool mirrored = glm::determinant(glm::dmat3(skeleton_.transforms[item.transform])) < 0;
      add_solid(range, mirrored, first, end, list);
    } else if (front == 0) {
      add_command(range, {.colored = range.colored}, first, end, list);
    } else {
      uint32_t begin = first;
      for (size_t run = 0; run <= range.outward_runs.size() && begin < end; ++run) {
        const uint32_t run_end =
            run < range.outward_runs.size() ? std::clamp(range.outward_runs[run], begin, end) : end;
        add_command(range, {.front = run % 2 == 1 ? front : 0, .colored = range.colored}, begin, run_end,
                    list);
        begin = run_end;
      }
    }
    for (const LatticeBox& box : item.pieces) list.bounds.push_back(projector_->pixel_bound(box));
    list.triangles += item.index_count / 3;
  }
}

}  // namespace triptych
