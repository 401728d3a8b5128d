#include "preprocess/hlod_unit.hpp"

#include "preprocess/cached_unit.hpp"
#include "preprocess/contacts/grow_joints.hpp"
#include "preprocess/contacts/inner_faces.hpp"
#include "preprocess/contacts/stitch.hpp"
#include "preprocess/covered/leave_out.hpp"
#include "preprocess/relocation.hpp"
#include "preprocess/triangle_objects.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

/// What make_levels() makes its result of.
void write_key(ContentKeyWriter& key, std::span<const HlodSource> sources, double error, uint32_t leaves,
               const std::vector<ErrorGap>& gaps, const HlodPlace& where) {
  write_unit_kind(key, UnitKind::hlod, where.options);
  bool colored = false, transparent = false, placed = false;
  key.write(uint64_t{sources.size()});
  for (const HlodSource& source : sources) {
    write_record(key, source.surface);
    write_record(key, source.spans);
    write_record(key, source.objects);
    key.write(source.seen_from_outside);
    key.write(source.lattice != nullptr);
    if (source.lattice) {
      key.write(*source.lattice);
      key.write(source.transform);
    }
    colored = colored || !source.surface.colors.empty();
    transparent = transparent || is_seen_through(source.surface, where.palette);
    placed = placed || source.lattice;
  }
  if (colored) key.write_all(where.palette.colors);
  if (transparent) key.write_all(std::span<const uint32_t>(seen_through_colors(where.palette)));
  if (placed) key.write(where.lattice.origin);
  key.write(where.lattice.step);
  key.write(error);
  key.write(leaves);
  write_record(key, gaps);
  key.write(where.has_objects);
}

/// A level that draws more than this share of what the children do, and more than was asked for, is not worth
/// it: of the children each is drawn only where it may be seen, and at its own distance.
constexpr double worth_it = 0.75;

/// Faces that stand against rods are grown into those; points that meet by that become one. Returns how far
/// any moved, model units.
double grow_joints(Baked& children, uint32_t leaves, double most, const HlodPlace& where) {
  constexpr uint32_t first = Relocation::own_first_place;
  std::vector<uint8_t> fixed;  // where a surface goes on elsewhere; where others touch it, it may grow
  for (const LeafSpan& span : children.spans)
    fixed.push_back(std::isinf(span.reach) && (span.first < first || span.last >= first + leaves));
  const double moved = grow_joints(children, fixed, most / where.lattice.step);
  if (moved == 0) return 0;
  Baker baker(where.lattice, where.palette.colors, where.options.rules);
  baker.add(children.surface, children.spans, children.objects);
  Baked grown = baker.finish(children.error + moved * where.lattice.step);
  grown.seen_from_outside = children.seen_from_outside;
  children = std::move(grown);
  return moved * where.lattice.step;
}

/// sources: of a subtree of so many leaves, in its own numbers.
UnitResult make_levels(std::span<const HlodSource> sources, double error, uint32_t leaves,
                       const std::vector<ErrorGap>& gaps, const HlodPlace& where) {
  const Lattice& lattice = where.lattice;
  Baked children = bake(sources, error, where);
  const auto share = static_cast<size_t>(worth_it * static_cast<double>(children.surface.triangles.size()));
  const size_t most = std::max<size_t>(share, where.options.hlod_triangles);
  constexpr double small = 1.0 / 64;
  const double early = std::max(children.error, small * diagonal(lattice.box(children.surface.box())));
  const bool is_opaque = !is_seen_through(children.surface, where.palette);
  double grown = 0;
  if (where.options.holds_contacts()) {
    if (is_opaque) grown = grow_joints(children, leaves, early, where);
    children.error += stitch(children) * lattice.step;
  }
  const size_t all = children.surface.triangles.size();
  if (where.options.holds_contacts() && where.options.keeps_order() && is_opaque)
    mark_inner_faces(children.surface, early / lattice.step, grown / lattice.step);
  children.error = std::max(children.error, lattice.step * leave_out_covered(children, early / lattice.step));
  const TriangleObjects objects(children);
  const HlodLimits limits{.triangles = where.options.hlod_triangles,
                          .simplify = where.options.simplify_limits(),
                          .gaps = gaps,
                          .begins_as_it_is = 4 * children.surface.triangles.size() <= 3 * all,
                          .shade = where.options.keep.shade};
  constexpr uint32_t first = Relocation::own_first_place;
  Hlod hlod = make_hlod(std::move(children), first, first + leaves, lattice, limits);
  hlod.coarsest.objects = objects.of(hlod.drawables.back().piece);
  std::erase_if(hlod.drawables,
                [&](const HlodDrawable& drawable) { return drawable.piece.surface.triangles.size() > most; });
  HlodFigures figures{{}, hlod.coarsest.error, hlod.stuck, {}};
  UnitResult result;
  for (HlodDrawable& drawable : hlod.drawables) {
    figures.errors.push_back(drawable.error);
    EncodedChunk chunk = encode(drawable.piece.surface, where.options.in_pieces(), where.palette);
    chunk.seen_from_outside = drawable.seen_from_outside && where.options.rules.levels_are_marked;
    if (where.has_objects) figures.objects.push_back(objects.encoded(drawable.piece, chunk));
    result.chunks.push_back({std::move(chunk), where.lattice_number});
  }
  result.geometry.push_back(record_bytes(hlod.coarsest));
  result.figures = record_bytes(figures);
  return result;
}

}  // namespace

Baked bake(std::span<const HlodSource> sources, double error, const HlodPlace& where) {
  Baker baker(where.lattice, where.palette.colors, where.options.rules);
  for (const HlodSource& source : sources) {
    if (source.lattice) {
      baker.add(source.surface, *source.lattice, source.transform, source.spans, source.objects);
    } else {
      baker.add(source.surface, source.spans, source.objects);
    }
  }
  Baked baked = baker.finish(error);
  baked.seen_from_outside = std::ranges::any_of(sources, &HlodSource::seen_from_outside);
  return baked;
}

UnitResult hlod_unit(std::vector<HlodSource> sources, double error, uint32_t first_place, uint32_t end_place,
                     const std::vector<ErrorGap>& gaps, const HlodPlace& where) {
  Relocation place(first_place, end_place);
  for (const HlodSource& source : sources) place.take_in(source.spans, source.objects);
  place.finish();
  for (HlodSource& source : sources) place.to_own(source.spans, source.objects);
  const uint32_t leaves = end_place - first_place;
  ContentKeyWriter key;
  if (where.options.cache) write_key(key, sources, error, leaves, gaps, where);
  UnitResult result = cached_unit(where.options.cache, "levels of scene nodes", key, where.lattice_number,
                                  [&] { return make_levels(sources, error, leaves, gaps, where); });
  auto coarsest = record_of<Baked>(result.geometry.at(0), "a build unit");
  place.to_model(coarsest.spans, coarsest.objects);
  result.geometry[0] = record_bytes(coarsest);
  auto figures = record_of<HlodFigures>(result.figures, "a build unit");
  for (std::vector<std::byte>& objects : figures.objects) objects = place.to_model(objects);
  result.figures = record_bytes(figures);
  return result;
}

}  // namespace triptych
