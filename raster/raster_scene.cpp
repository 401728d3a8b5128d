#include "raster/raster_scene.hpp"

#include "visibility/facing.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace triptych {

RasterScene::RasterScene(const Skeleton& skeleton, Representation& representation, Residency& residency)
    : skeleton_(skeleton),
      representation_(representation),
      geometry_(skeleton, residency),
      textures_(skeleton, residency),
      placer_(skeleton),
      cut_bodies_(skeleton),
      everywhere_(max_chunk_pieces,
                  skeleton.scene_nodes.empty() ? LatticeBox() : skeleton.scene_nodes[0].box) {}

[[gnu::noinline]] void RasterScene::set_view(const FrameView& view) {
  // A changed cap holds for a camera that rests, too.
  const bool same = view_ && view.state == view_->state && view.rules == view_->rules;
  if (same && !std::exchange(cap_changed_, false)) return;
  view_ = view;
  geometry_.begin_view();
  textures_.begin_view();
  representation_.begin(view);
  placer_.begin(view);
  projector_.emplace(view, steady_margins);
  terms_.clear();
  for (const SamplePlace& place : sample_places(view.state.samples)) {
    terms_.emplace_back(*view_, *projector_, place);
    terms_.back().textures = &textures_;
    terms_.back().materials = skeleton_.materials;
  }
}

uint64_t RasterScene::place(std::span<const DrawableId> drawables) {
  // Front to back, so that tiles hide what comes later; the result is the same in any order.
  ranks_.clear();
  for (const DrawableId id : drawables) ranks_.push_back(draw_rank(*view_, id));
  std::sort(ranks_.begin(), ranks_.end());
  items_.clear();
  for (const DrawRank& rank : ranks_) representation_.append(rank.id, items_);
  geometry_.require(items_);
  cut_bodies_.find(*view_, items_);
  for (const CutRun& run : cut_bodies_.runs()) geometry_.require(run.chunk);
  stretches_.clear();
  transparent_stretches_.clear();
  names_.clear();
  const bool transparency = view_->state.effects.has(Effect::transparency),
             textures = view_->state.effects.has(Effect::textures);
  uint64_t triangles = 0;
  auto rank = ranks_.begin();
  for (const DrawItem& item : items_) {
    const bool same = !names_.empty() && names_.back().rank.id == item.drawable;
    while (rank->id != item.drawable) ++rank;
    names_.push_back({*rank, same ? names_.back().part + 1 : 0});
    const RasterChunk* const chunk = geometry_.chunk(item.chunk);
    if (chunk == nullptr) continue;
    const SectionPlace place = view_->section_place(item.pieces);
    if (place.outside) continue;
    PlacedStretch stretch{.rank = names_.back().rank,
                          .part = names_.back().part,
                          .chunk = chunk,
                          .first_triangle = item.first_index / 3,
                          .triangle_count = item.index_count / 3,
                          .placed = placer_.place(item.transform, skeleton_.chunks[item.chunk].lattice),
                          .front = 0,
                          .cut = place.cut,
                          .pieces = item.pieces};
    if (stretch.chunk->has_outward)
      stretch.front = outward_front(*view_, view_->transform(item.transform), item.pieces);
    triangles += stretch.triangle_count;
    const uint32_t first = stretch.first_triangle, end = first + stretch.triangle_count;
    const auto add = [&](uint32_t from, uint32_t to, std::vector<PlacedStretch>& stretches) {
      stretch.first_triangle = from;
      stretch.triangle_count = to - from;
      stretches.push_back(stretch);
    };
    const auto add_opaque = [&](uint32_t from, uint32_t to) {
      if (!textures || chunk->cut_out.empty()) return add(from, to, stretches_);
      for_each_run(chunk->cut_out, from, to, [&](uint32_t begin, uint32_t last, bool cut_out) {
        stretch.cut_out = cut_out;
        add(begin, last, stretches_);
      });
      stretch.cut_out = false;
    };
    if (!transparency || chunk->transparent.empty()) {
      add_opaque(first, end);
      continue;
    }
    for_each_run(chunk->transparent, first, end, [&](uint32_t from, uint32_t to, bool transparent) {
      transparent ? add(from, to, transparent_stretches_) : add_opaque(from, to);
    });
  }
  return triangles;
}

[[gnu::noinline]] uint64_t RasterScene::draw(std::span<const DrawableId> drawables, SamplePlanes& planes,
                                             std::vector<DrawableId>& transparent) {
  assert(planes.size() == terms_.size());
  const uint64_t triangles = place(drawables);
  for (const PlacedStretch& stretch : transparent_stretches_) {
    if (transparent.empty() || transparent.back() != stretch.rank.id) transparent.push_back(stretch.rank.id);
  }
  add_cap_runs();
  for (size_t i = 0; i < planes.size(); ++i) {
    planes[i].draw(terms_[i], stretches_);
    planes[i].draw_caps(terms_[i], cap_runs_, cap_counters_);
  }
  return triangles;
}

std::vector<TransparentLayers> RasterScene::transparent_layers(std::span<const DrawableId> drawables,
                                                               const SamplePlanes& planes,
                                                               size_t max_fragments) {
  place(drawables);
  std::vector<TransparentLayers> layers;
  for (size_t i = 0; i < planes.size(); ++i)
    layers.emplace_back(terms_[i], transparent_stretches_, planes[i], max_fragments);
  return layers;
}

void RasterScene::add_cap_runs() {
  cap_runs_.clear();
  for (const CutBody& body : cut_bodies_.all()) {
    const std::span<const CutRun> runs = cut_bodies_.runs_of(body);
    // A surface of which a part is still to be read has no winding numbers.
    if (std::ranges::any_of(runs, [&](const CutRun& run) { return geometry_.chunk(run.chunk) == nullptr; }))
      continue;
    for (size_t i = 0; i < runs.size(); ++i) {
      const CutRun& run = runs[i];
      const bool drawn = run.item != no_id;
      const Name name = drawn ? names_[run.item] : Name();
      cap_runs_.push_back({{.rank = name.rank,
                            .part = name.part,
                            .chunk = geometry_.chunk(run.chunk),
                            .first_triangle = run.first_triangle,
                            .triangle_count = run.triangle_count,
                            .placed = placer_.place(body.transform, skeleton_.chunks[run.chunk].lattice),
                            .front = 0,
                            .cut = body.cut,
                            .pieces = drawn ? items_[run.item].pieces : everywhere(run.chunk)},
                           drawn,
                           i == 0,
                           i + 1 == runs.size()});
    }
  }
}

}  // namespace triptych
