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
  const bool fits = !list.groups.empty() && list.groups.back().caps == DrawGroup::Caps::none &&
                    list.groups.back().front == group.front && list.groups.back().is_alike(group);
  if (!fits) list.groups.push_back(group);
  ++list.groups.back().count;
}

/// The group of the body's caps: all of its runs count, and those that the items first to last draw show.
void DrawListBuilder::add_caps(std::span<const ChunkRange> ranges, std::span<const DrawItem> items,
                               const CutBody& body, std::span<const CutRun> runs, uint32_t first,
                               uint32_t last, DrawList& list) {
  const Affine transform = view_->transform(body.transform);
  const bool mirrored = glm::determinant(glm::dmat3(transform)) < 0, colored = ranges[runs[0].chunk].colored,
             textured = ranges[runs[0].chunk].textured;
  // A surface of which a part is still to be read has no winding numbers; and all chunks of a mesh have
  // colours, or none.
  const auto differs = [&](const CutRun& run) {
    const ChunkRange& range = ranges[run.chunk];
    return !range.loaded() || range.colored != colored || range.textured != textured;
  };
  if (std::ranges::any_of(runs, differs)) return;
  DrawGroup group{.colored = colored,
                  .textured = textured,
                  .caps = mirrored ? DrawGroup::Caps::mirrored : DrawGroup::Caps::plain};
  shown_.clear();
  for (const CutRun& run : runs) {
    const bool drawn = run.item != no_id;
    DrawRecord record = this->record(body.transform, skeleton_.chunks[run.chunk].lattice, list);
    record.item = drawn ? items[run.item].drawable : no_id;
    record.cut = body.cut | DrawRecord::closed | (mirrored ? DrawRecord::mirrored : 0);
    list.records.push_back(record);
    if (drawn) {
      for (const LatticeBox& box : items[run.item].pieces)
        list.bounds.push_back(projector_->pixel_bound(box));
    } else {
      list.bounds.resize(list.bounds.size() + skeleton_.pieces_of(run.chunk).size());
    }
    const ChunkRange& range = ranges[run.chunk];
    const DrawCommand command{.index_count = 3 * run.triangle_count,
                              .instance_count = 1,
                              .first_index = range.first_index + 3 * run.first_triangle,
                              .base_vertex = static_cast<int32_t>(range.base_vertex),
                              .base_instance = static_cast<uint32_t>(list.records.size() - 1)};
    list.commands.push_back(command);
    ++group.count;
    if (drawn && run.item >= first && run.item <= last) shown_.push_back(command);
  }
  group.shown = static_cast<uint32_t>(shown_.size());
  list.commands.insert(list.commands.end(), shown_.begin(), shown_.end());
  list.groups.push_back(group);
}

/// Under the transform; its bounds are those that are added next.
DrawRecord DrawListBuilder::record(uint32_t transform, uint32_t lattice, const DrawList& list) {
  const PlacedLattice placed = placer_.place(transform, lattice);
  DrawRecord record{};
  record.first_bound = static_cast<uint32_t>(list.bounds.size());
  record.cell = placed.cell;
  std::copy(std::begin(placed.rows), std::end(placed.rows), record.rows);
  return record;
}

void DrawListBuilder::append(std::span<const ChunkRange> ranges, std::span<const DrawItem> items,
                             const CutBodies& bodies, DrawPart part, DrawList& list) {
  capped_items_.clear();
  for (uint32_t body = 0; part != DrawPart::transparent && body < bodies.all().size(); ++body) {
    for (const CutRun& run : bodies.runs_of(bodies.all()[body])) {
      if (run.item != no_id) capped_items_.push_back({run.item, body});
    }
  }
  std::ranges::sort(capped_items_);
  auto capped = capped_items_.begin();
  for (uint32_t i = 0; i < items.size(); ++i) {
    add_surfaces(ranges[items[i].chunk], items[i], part, list);
    // Those of a body right behind the last of the items that follow each other and show it.
    for (; capped != capped_items_.end() && capped->first == i; ++capped) {
      const uint32_t body = capped->second;
      const auto shows = [&](uint32_t item) {
        return std::ranges::binary_search(capped_items_, std::pair(item, body));
      };
      if (shows(i + 1)) continue;
      uint32_t first = i;
      while (first > 0 && shows(first - 1)) --first;
      add_caps(ranges, items, bodies.all()[body], bodies.runs_of(bodies.all()[body]), first, i, list);
    }
  }
}

void DrawListBuilder::add_surfaces(const ChunkRange& range, const DrawItem& item, DrawPart part,
                                   DrawList& list) {
  if (!range.loaded() || (part == DrawPart::transparent && range.transparent.empty())) return;
  const SectionPlace place = view_->section_place(item.pieces);
  if (place.outside) return;
  const bool few_runs = !range.outward_runs.empty() && range.outward_runs.size() <= max_runs;
  const int32_t front = !few_runs ? 0 : outward_front(*view_, view_->transform(item.transform), item.pieces);
  DrawRecord record = this->record(item.transform, skeleton_.chunks[item.chunk].lattice, list);
  record.item = item.drawable;
  record.cut = place.cut;
  list.records.push_back(record);
  uint32_t begin = item.first_index / 3;
  const uint32_t end = begin + item.index_count / 3;
  const auto add = [&](int32_t shown_front, uint32_t first, uint32_t last) {
    const DrawGroup group{.front = shown_front,
                          .colored = range.colored,
                          .textured = range.textured,
                          .emissive = range.emissive,
                          .cut_out = range.cut_out,
                          .lit = range.lit,
                          .layered = range.layered,
                          .normals = range.normals};
    if (part == DrawPart::all || range.transparent.empty())
      return add_command(range, group, first, last, list);
    for_each_run(range.transparent, first, last, [&](uint32_t from, uint32_t to, bool transparent) {
      if (transparent == (part == DrawPart::transparent)) add_command(range, group, from, to, list);
    });
  };
  for (size_t run = 0; front != 0 && run < range.outward_runs.size() && begin < end; ++run) {
    const uint32_t run_end = std::clamp(range.outward_runs[run], begin, end);
    add(run % 2 == 1 ? front : 0, begin, run_end);
    begin = run_end;
  }
  add(0, begin, end);
  for (const LatticeBox& box : item.pieces) list.bounds.push_back(projector_->pixel_bound(box));
  list.triangles += item.index_count / 3;
}

}  // namespace triptych
