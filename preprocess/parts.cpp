#include "preprocess/parts.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"
#include "preprocess/closed_groups.hpp"
#include "preprocess/contacts/close_seams.hpp"
#include "preprocess/covered/closed_surface.hpp"
#include "preprocess/divide.hpp"
#include "preprocess/sorted_mesh.hpp"
#include "preprocess/weld.hpp"
#include "simplify/level_normals.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <glm/glm.hpp>
#include <numeric>

namespace triptych {

namespace {

struct PartFigures {
  uint32_t triangles = 0, borders = 0;
  uint32_t color = no_id;  ///< PartInfo::color
  bool transparent = false;
  Outside outside = Outside::none;
  std::vector<LatticeBox> boxes;  ///< in each of the mesh's instances
  std::vector<PartRun> runs;      ///< Division's
  PartRun rest = {};              ///< of a bucket's part: what follows
};

/// What is known of a mesh, or of a bucket of one, beside the geometry of its parts.
struct DivisionFigures {
  uint64_t dropped_triangles = 0, welded_vertices = 0, lone_triangles = 0, turned_bodies = 0;
  uint32_t moved = 0;                       ///< PartInfo::moved
  uint32_t own_borders = 0, first_own = 0;  ///< Division's
  uint32_t bodies = 0;                      ///< Division's
  EdgeSum rest = {};                        ///< of a bucket: of what is not closed
  std::vector<PartFigures> parts;
};

}  // namespace

template <>
inline constexpr auto record_members<PartFigures> = std::tuple(&PartFigures::triangles, &PartFigures::borders,
                                                               &PartFigures::color, &PartFigures::transparent,
                                                               &PartFigures::outside, &PartFigures::boxes,
                                                               &PartFigures::runs, &PartFigures::rest);
template <>
inline constexpr auto record_members<DivisionFigures> = std::tuple(
    &DivisionFigures::dropped_triangles, &DivisionFigures::welded_vertices, &DivisionFigures::lone_triangles,
    &DivisionFigures::turned_bodies, &DivisionFigures::moved, &DivisionFigures::own_borders,
    &DivisionFigures::first_own, &DivisionFigures::bodies, &DivisionFigures::rest, &DivisionFigures::parts);

namespace {

/// PartInfo::color.
uint32_t color_of(const Surface& surface) {
  if (!surface.colors.empty() || surface.triangles.empty()) return no_id;
  const uint32_t color = surface.triangles.front().material;
  const bool is_everywhere =
      std::all_of(surface.triangles.begin(), surface.triangles.end(),
                  [&](const Triangle& triangle) { return triangle.material == color; });
  return is_everywhere ? color : no_id;
}

/// A box on the lattice `to` that holds the surface under the transform.
LatticeBox placed_box(const Surface& surface, const Lattice& lattice, const Affine& transform,
                      const Lattice& to) {
  Box box;
  for (const glm::ivec3& point : surface.points) {
    box.extend(transform * glm::dvec4(lattice.position(point), 1));
  }
  LatticeBox enclosing = to.enclosing(box);
  enclosing.lo -= 1;  // rounding in the transform
  enclosing.hi += 1;
  return enclosing;
}

class PartMaker {
 public:
  PartMaker(const Model& model, const BuildPlan& plan, const BuildOptions& options, BuildWork& work)
      : border_counts(plan.meshes.size(), 0),
        model_(model),
        plan_(plan),
        options_(options),
        work_(work),
        progress_("partitioning", triangles_of(plan)) {
    // Borders between parts stay as they are in all levels, and that costs triangles: a mesh that is small in
    // the model, such as a piece of furniture, is only divided if it has very many.
    const double whole = diagonal(plan.box());
    small_ = whole / 32;
    large_ = whole / 6;
  }

  void run() {
    std::vector<uint32_t> all(plan_.meshes.size());
    std::iota(all.begin(), all.end(), 0u);
    for (size_t first = 0; first < all.size();) {
      if (is_large(first)) {
        divide_sorted(all[first++]);
        continue;
      }
      size_t next_large = first;
      while (next_large < all.size() && !is_large(next_large)) ++next_large;
      const size_t end = end_of_group(first, next_large, unit_triangles(options_),
                                      [&](size_t mesh) { return plan_.meshes[mesh].triangles; });
      work_.run(
          UnitKind::divided_mesh, std::span(all).subspan(first, end - first),
          [&](uint32_t mesh) { return record_bytes(divide_whole(plan_.meshes[mesh])); },
          [&](uint32_t mesh, const StoredUnit& stored) {
            take(mesh, stored);
            progress_.advance(plan_.meshes[mesh].triangles);
          });
      first = end;
    }
  }

  std::vector<PartInfo> infos;
  std::vector<uint32_t> meshes;                ///< for each part its planned mesh
  std::vector<uint32_t> border_counts;         ///< for each planned mesh
  std::vector<std::vector<LatticeBox>> boxes;  ///< for each part its box in each of the mesh's instances
  uint64_t dropped_triangles = 0, welded_vertices = 0, lone_triangles = 0, turned_bodies = 0;
  double largest_step = 0;  ///< of the lattices of lone triangles
  uint32_t bodies = 0;      ///< that are divided among parts

 private:
  static uint64_t triangles_of(const BuildPlan& plan) {
    uint64_t total = 0;
    for (const PlannedMesh& mesh : plan.meshes) total += mesh.triangles;
    return total;
  }

  bool is_large(size_t mesh) const { return plan_.meshes[mesh].triangles > options_.bucket_triangles; }

  void take(uint32_t mesh, const StoredUnit& stored) {
    const auto figures = stored.figures_as<DivisionFigures>();
    dropped_triangles += figures.dropped_triangles;
    welded_vertices += figures.welded_vertices;
    turned_bodies += figures.turned_bodies;
    if (figures.lone_triangles > 0) {
      lone_triangles += figures.lone_triangles;
      const PlannedMesh& planned = plan_.meshes[mesh];
      largest_step = std::max(largest_step, plan_.lattices[planned.lattice].step * planned.stretch);
    }
    for (size_t i = 0; i < figures.parts.size(); ++i) {
      const PartFigures& part = figures.parts[i];
      meshes.push_back(mesh);
      infos.push_back({.place = stored.geometry.at(i),
                       .lattice = plan_.meshes[mesh].lattice,
                       .triangles = part.triangles,
                       .borders = part.borders,
                       .moved = figures.moved,
                       .own_borders_from = figures.first_own,
                       .own_borders_behind = border_counts[mesh] - figures.first_own,
                       .color = part.color,
                       .transparent = part.transparent,
                       .outside = part.outside,
                       .runs = part.runs});
      for (PartRun& run : infos.back().runs) {
        if (run.body != no_id) run.body += bodies;
      }
      boxes.push_back(part.boxes);
    }
    border_counts[mesh] += figures.own_borders;
    bodies += figures.bodies;
    rest_.add(figures.rest);
    for (const PartFigures& part : figures.parts) rests_.push_back(part.rest);
  }

  PartitionLimits limits(const PlannedMesh& mesh, uint64_t triangles) const {
    PartitionLimits limits;
    const Lattice& lattice = plan_.lattices[mesh.lattice];
    limits.triangles = options_.part_triangles;
    if (diagonal(mesh.box) * mesh.stretch < small_ && triangles <= uint64_t{options_.part_triangles} * 8) {
      limits.triangles = triangles;
    }
    limits.diagonal = large_ / (mesh.stretch * lattice.step);
    return limits;
  }

  UnitResult divide_welded(const PlannedMesh& mesh, Welded welded, const PartitionLimits& limits,
                           std::span<const SharedPoint> shared, uint32_t first_own) const {
    ClosedTriangles closed = find_closed(welded.surface);
    ClosedSeams seams;
    // Points that buckets share stay what they are.
    if (shared.empty() && options_.holds_contacts()) seams = close_seams(welded.surface, closed);
    if (seams.points > 0) closed = find_closed(welded.surface);
    // What a bucket has may be the wall of a cavity in what several of them have.
    const uint64_t turned = shared.empty() ? turn_outward(welded.surface, closed) : 0;
    join_cavities(welded.surface, closed);
    drop_plain_normals(welded.surface);
    const Division division = divide(welded.surface, limits, closed, shared, first_own);
    DivisionFigures figures{.dropped_triangles = welded.dropped_triangles,
                            .welded_vertices = welded.welded_vertices + seams.points,
                            .lone_triangles = welded.lone_triangles,
                            .turned_bodies = turned,
                            .moved = (welded.enlarged_triangles > 0 ? 1u : 0u) + seams.moved,
                            .own_borders = division.own_borders,
                            .first_own = division.first_own,
                            .bodies = division.bodies,
                            .rest = {},
                            .parts = {}};
    // Of a bucket nobody knows, and through what is transparent or cut out backs are seen.
    const bool has_outside =
        shared.empty() && options_.keeps_order() && !is_seen_through(welded.surface, plan_.palette_view());
    const Outside outside = has_outside ? outside_of(welded.surface) : Outside::none;
    UnitResult result;
    for (const Part& part : division.parts) {
      PartFigures& of_part =
          figures.parts.emplace_back(PartFigures{static_cast<uint32_t>(part.surface.triangles.size()),
                                                 static_cast<uint32_t>(part.borders.size()),
                                                 color_of(part.surface),
                                                 is_seen_through(part.surface, plan_.palette_view()),
                                                 outside,
                                                 {},
                                                 division.runs[figures.parts.size()],
                                                 {}});
      if (!shared.empty()) add_rest(part.surface, of_part, figures.rest);
      for (const uint32_t instance : mesh.instances) of_part.boxes.push_back(box_in(instance, mesh, part));
      result.geometry.push_back(record_bytes(part));
    }
    result.figures = record_bytes(figures);
    return result;
  }

  /// What of a bucket's part is not closed may be so together with other buckets.
  static void add_rest(const Surface& surface, PartFigures& part, EdgeSum& sum) {
    size_t first = 0;
    for (const PartRun& run : part.runs) first += run.triangles;
    part.rest.triangles = static_cast<uint32_t>(surface.triangles.size() - first);
    for (const auto& [vertices, material] : std::span(surface.triangles).subspan(first)) {
      const std::array corners = {surface.points[vertices[0]], surface.points[vertices[1]],
                                  surface.points[vertices[2]]};
      sum.add(corners);
      for (const glm::ivec3& corner : corners) part.rest.box.extend(corner);
    }
  }

  /// What is left of the mesh's buckets is one body, if it is closed.
  void join_rests(size_t first_part) {
    const bool is_body =
        rest_.is_closed() && std::ranges::any_of(rests_, [](auto& r) { return r.triangles > 0; });
    for (size_t i = 0; is_body && i < rests_.size(); ++i) {
      if (rests_[i].triangles == 0) continue;
      infos[first_part + i].runs.push_back({rests_[i].triangles, bodies, rests_[i].box});
    }
    bodies += is_body ? 1 : 0;
  }

  LatticeBox box_in(uint32_t index, const PlannedMesh& mesh, const Part& part) const {
    if (mesh.baked) return part.surface.box();
    const PlannedInstance& instance = plan_.instances[index];
    const PlannedHierarchy& hierarchy = plan_.hierarchies[instance.hierarchy];
    return placed_box(part.surface, plan_.lattices[mesh.lattice], hierarchy.transforms[instance.transform],
                      plan_.lattices[hierarchy.lattice]);
  }

  UnitResult divide_whole(const PlannedMesh& mesh) const {
    if (mesh.triangles == 0) return {{}, {}, record_bytes(DivisionFigures())};
    Welded welded =
        weld(model_.meshes[mesh.mesh], mesh.transform, plan_.lattices[mesh.lattice], plan_.colors_of(mesh));
    const PartitionLimits of_mesh = limits(mesh, welded.surface.triangles.size());
    return divide_welded(mesh, std::move(welded), of_mesh, {}, 0);
  }

  /// A mesh that is too large for memory: sorted into buckets, which are then divided.
  void divide_sorted(uint32_t index) {
    const PlannedMesh& mesh = plan_.meshes[index];
    const Mesh& source = model_.meshes[mesh.mesh];
    const MeshColors colors = plan_.colors_of(mesh);
    const CornerStreams streams = corner_streams(source, colors);
    SortedMesh sorted(source, ToLattice(mesh.transform, plan_.lattices[mesh.lattice], colors),
                      options_.bucket_triangles, work_.file("buckets"));
    std::vector<uint64_t> sizes;
    work_.run(
        UnitKind::sorted_mesh, std::span(&index, 1), [&](uint32_t) { return record_bytes(sorted.unit()); },
        [&](uint32_t, const StoredUnit& stored) {
          auto figures = stored.figures_as<SortFigures>();
          dropped_triangles += figures.not_finite;
          border_counts[index] = figures.shared_points;
          sizes = std::move(figures.bucket_triangles);
        });
    std::vector<uint32_t> buckets(sizes.size());
    std::iota(buckets.begin(), buckets.end(), first_bucket_);
    const PartitionLimits part_limits = limits(mesh, mesh.triangles);
    const size_t first_part = infos.size();
    rest_ = {};
    rests_.clear();
    for (size_t first = 0; first < sizes.size();) {
      const size_t end = end_of_group(first, sizes.size(), unit_triangles(options_),
                                      [&](size_t bucket) { return sizes[bucket]; });
      work_.run(
          UnitKind::divided_bucket, std::span(buckets).subspan(first, end - first),
          [&](uint32_t number) {
            Bucket bucket = sorted.buckets().load(number - first_bucket_);
            Welded welded = weld(bucket.triangles, streams);
            bucket.triangles = {};
            return record_bytes(divide_welded(mesh, std::move(welded), part_limits, bucket.shared,
                                              sorted.buckets().shared_points()));
          },
          [&](uint32_t number, const StoredUnit& stored) {
            take(index, stored);
            progress_.advance(sizes[number - first_bucket_]);
          });
      first = end;
    }
    join_rests(first_part);
    first_bucket_ += static_cast<uint32_t>(sizes.size());
  }

  const Model& model_;
  const BuildPlan& plan_;
  const BuildOptions& options_;
  BuildWork& work_;
  Progress progress_;
  double small_ = 0, large_ = 0;
  uint32_t first_bucket_ = 0;  ///< how many buckets the meshes before this one have
  EdgeSum rest_;               ///< of the mesh's buckets so far, as `rests_`: of each part
  std::vector<PartRun> rests_;
};

}  // namespace

std::vector<BorderPoint> load_borders(const SpoolFile& file, const PartInfo& part) {
  const uint64_t size = uint64_t{part.borders} * sizeof(BorderPoint);  // the last bytes of the part's record
  const std::vector<std::byte> bytes = file.read({part.place.offset + part.place.size - size, size});
  auto borders = ByteReader(bytes, file.path().string()).read_all<BorderPoint>(part.borders);
  for (BorderPoint& border : borders) {
    if (border.number >= part.own_borders_from) border.number += part.own_borders_behind;
  }
  return borders;
}

Parts make_parts(const Model& model, BuildPlan plan, const BuildOptions& options, BuildWork& work,
                 ImportReport& report) {
  PartMaker maker(model, plan, options, work);
  maker.run();
  report.dropped_triangles += maker.dropped_triangles;
  report.welded_vertices += maker.welded_vertices;
  if (maker.lone_triangles > 0) {
    report.warnings.push_back(fmt::format(
        "{} triangles are less than a step of their lattice wide, up to {} model units, and would "
        "have vanished: they are drawn a step wide",
        maker.lone_triangles, maker.largest_step));
  }

  if (maker.turned_bodies > 0) {
    report.warnings.push_back(fmt::format(
        "{} closed surfaces were inside out, and are turned round: they are solid", maker.turned_bodies));
  }

  // The parts of one mesh came one after the other.
  Parts parts;
  std::vector<uint32_t> first(plan.meshes.size() + 1, 0);
  for (const uint32_t mesh : maker.meshes) ++first[mesh + 1];
  for (size_t mesh = 0; mesh < plan.meshes.size(); ++mesh) first[mesh + 1] += first[mesh];
  for (PlannedHierarchy& planned : plan.hierarchies) {
    parts.hierarchies.push_back({.placed = {},
                                 .boxes = {},
                                 .contacts = {},
                                 .border_counts = {},
                                 .objects = {},
                                 .transforms = std::move(planned.transforms),
                                 .stretches = std::move(planned.stretches),
                                 .sub_hierarchies = std::move(planned.sub_hierarchies),
                                 .lattice = planned.lattice,
                                 .instances = 0,
                                 .uses = planned.uses});
  }
  std::vector<uint32_t> ordinals(plan.meshes.size(), 0);  // of the next instance of each mesh
  uint64_t placed_instances = 0;
  for (size_t i = 0; i < plan.instances.size(); ++i) {
    const PlannedInstance& instance = plan.instances[i];
    PlacedParts& hierarchy = parts.hierarchies[instance.hierarchy];
    const auto number = static_cast<uint32_t>(hierarchy.border_counts.size());
    const uint32_t ordinal = ordinals[instance.mesh]++;
    hierarchy.border_counts.push_back(maker.border_counts[instance.mesh]);
    if (!plan.objects.empty()) hierarchy.objects.push_back(plan.objects[i]);
    for (uint32_t part = first[instance.mesh]; part < first[instance.mesh + 1]; ++part) {
      hierarchy.placed.push_back({part, instance.transform, number});
      hierarchy.boxes.push_back(maker.boxes[part][ordinal]);
    }
    if (first[instance.mesh + 1] == first[instance.mesh]) continue;
    ++hierarchy.instances;
    ++placed_instances;
  }
  if (placed_instances == 0) fail(model.name(), "holds no triangle with an area");
  parts.parts = std::move(maker.infos);
  parts.lattices = std::move(plan.lattices);
  parts.palette = std::move(plan.palette);
  parts.materials = std::move(plan.materials);
  parts.motion = std::move(plan.motion);
  parts.bodies = maker.bodies;
  parts.has_objects = !plan.objects.empty();
  return parts;
}

}  // namespace triptych
