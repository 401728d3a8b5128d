#include "preprocess/parts.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/threads.hpp"
#include "model/read_mesh.hpp"
#include "preprocess/buckets.hpp"
#include "preprocess/divide.hpp"
#include "preprocess/weld.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <glm/glm.hpp>
#include <optional>

namespace triptych {

namespace {

/// A lattice box, on the model's lattice, that holds the surface under the transform.
LatticeBox placed_box(const Surface& surface, const Lattice& lattice, const Affine& transform,
                      const Lattice& model) {
  Box box;
  for (const glm::ivec3& point : surface.points) {
    box.extend(transform * glm::dvec4(lattice.position(point), 1));
  }
  LatticeBox enclosing = model.enclosing(box);
  enclosing.lo -= 1;  // rounding in the transform
  enclosing.hi += 1;
  return enclosing;
}

/// What one mesh, or one bucket of it, came to.
struct Divided {
  Division division;
  std::vector<std::vector<LatticeBox>> boxes;  ///< for each part its box in each of the mesh's instances
  uint64_t dropped_triangles = 0, welded_vertices = 0, lone_triangles = 0;
  bool enlarged = false;  ///< points were moved by a step, so that nothing vanishes
};

class PartMaker {
 public:
  PartMaker(const Model& model, const BuildPlan& plan, const BuildOptions& options, BuildWork& work)
      : border_counts(plan.meshes.size(), 0),
        model_(model),
        plan_(plan),
        options_(options),
        work_(work),
        unit_triangles_(unit_triangles(options)) {
    // Borders between parts stay as they are in all levels, and that costs triangles: a mesh that is small in
    // the model, such as a piece of furniture, is parted only if it has a great many.
    const double whole = diagonal(plan.box);
    small_ = whole / 32;
    large_ = whole / 6;
  }

  void run() {
    uint64_t total = 0;
    for (const PlannedMesh& mesh : plan_.meshes) total += mesh.triangles;
    Progress progress("partitioning", total);
    const auto count = static_cast<uint32_t>(plan_.meshes.size());
    for (uint32_t first = 0; first < count;) {
      if (plan_.meshes[first].triangles > options_.bucket_triangles) {
        divide_in_buckets(first++, progress);
        continue;
      }
      uint32_t small = first;
      while (small < count && plan_.meshes[small].triangles <= options_.bucket_triangles) ++small;
      const auto end = static_cast<uint32_t>(end_of_group(
          first, small, unit_triangles_, [&](size_t mesh) { return plan_.meshes[mesh].triangles; }));
      unit(
          end - first, [] {}, [&](uint32_t i) { return divide_whole(first + i); },
          [&](uint32_t i) { return first + i; });
      for (; first < end; ++first) progress.advance(plan_.meshes[first].triangles);
    }
  }

  std::vector<PartInfo> infos;
  std::vector<uint32_t> meshes;                ///< for each part its planned mesh
  std::vector<uint32_t> border_counts;         ///< for each planned mesh
  std::vector<std::vector<LatticeBox>> boxes;  ///< for each part its box in each of the mesh's instances
  uint64_t dropped_triangles = 0, welded_vertices = 0, lone_triangles = 0;
  double largest_step = 0;  ///< of the lattices of lone triangles

 private:
  /// Meshes or buckets side by side; their parts go to the spool file in order.
  template <typename Prepare, typename Divide, typename MeshOf>
  void unit(uint32_t count, const Prepare& prepare, const Divide& divide_one, const MeshOf& mesh_of) {
    work_.unit(
        [&](ByteWriter& record) {
          prepare();
          std::vector<Divided> results(count);
          parallel_for(count, [&](size_t i) { results[i] = divide_one(static_cast<uint32_t>(i)); });
          for (uint32_t i = 0; i < count; ++i) put(record, mesh_of(i), results[i]);
        },
        [&](ByteReader& record) {
          for (uint32_t i = 0; i < count; ++i) take(record);
        });
  }

  /// Border points that only a bucket's parts have come behind those of the buckets before it.
  void number_borders(uint32_t mesh, Division& division) {
    const uint32_t behind = border_counts[mesh] - division.first_own;
    for (Part& part : division.parts) {
      for (BorderPoint& border : part.borders) {
        if (border.number >= division.first_own) border.number += behind;
      }
    }
    border_counts[mesh] += division.own_borders;
  }

  void put(ByteWriter& record, uint32_t mesh, Divided& divided) {
    record.write(mesh);
    record.write(divided.dropped_triangles);
    record.write(divided.welded_vertices);
    record.write(divided.lone_triangles);
    number_borders(mesh, divided.division);
    record.write(border_counts[mesh]);
    record.write(uint64_t{divided.division.parts.size()});
    for (size_t i = 0; i < divided.division.parts.size(); ++i) {
      const Part& part = divided.division.parts[i];
      record.write(PartInfo{store(work_.parts(), part), plan_.meshes[mesh].lattice,
                            static_cast<uint32_t>(part.surface.triangles.size()),
                            static_cast<uint32_t>(part.borders.size()), divided.enlarged ? 1u : 0u});
      record.write(uint64_t{divided.boxes[i].size()});
      record.write_all(std::span<const LatticeBox>(divided.boxes[i]));
    }
  }

  void take(ByteReader& record) {
    const auto mesh = record.read<uint32_t>();
    dropped_triangles += record.read<uint64_t>();
    welded_vertices += record.read<uint64_t>();
    if (const auto lone = record.read<uint64_t>()) {
      lone_triangles += lone;
      const PlannedMesh& planned = plan_.meshes[mesh];
      largest_step = std::max(largest_step, plan_.lattices[planned.lattice].step * planned.stretch);
    }
    border_counts[mesh] = record.read<uint32_t>();
    for (auto count = record.read<uint64_t>(); count > 0; --count) {
      meshes.push_back(mesh);
      infos.push_back(record.read<PartInfo>());
      boxes.push_back(record.read_all<LatticeBox>(record.read<uint64_t>()));
    }
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

  Divided finish(const PlannedMesh& mesh, const Welded& welded, const PartitionLimits& limits,
                 std::span<const SharedPoint> shared, uint32_t first_own) const {
    Divided divided;
    divided.dropped_triangles = welded.dropped_triangles;
    divided.welded_vertices = welded.welded_vertices;
    divided.lone_triangles = welded.lone_triangles;
    divided.enlarged = welded.enlarged_triangles > 0;
    divided.division = divide(welded.surface, limits, shared, first_own);
    const Lattice& lattice = plan_.lattices[mesh.lattice];
    for (const Part& part : divided.division.parts) {
      auto& part_boxes = divided.boxes.emplace_back();
      for (const uint32_t instance : mesh.instances) {
        const uint32_t transform = plan_.instances[instance].transform;
        part_boxes.push_back(mesh.lattice == 0 ? part.surface.box()
                                               : placed_box(part.surface, lattice,
                                                            plan_.transforms[transform], plan_.lattices[0]));
      }
    }
    return divided;
  }

  Divided divide_whole(uint32_t index) const {
    const PlannedMesh& mesh = plan_.meshes[index];
    if (mesh.triangles == 0) return {};
    const Welded welded =
        weld(model_.meshes[mesh.mesh], mesh.transform, plan_.lattices[mesh.lattice], plan_.colors);
    return finish(mesh, welded, limits(mesh, welded.surface.triangles.size()), {}, 0);
  }

  void divide_in_buckets(uint32_t index, Progress& progress) {
    const PlannedMesh& mesh = plan_.meshes[index];
    const ToLattice to_lattice(mesh.transform, plan_.lattices[mesh.lattice], plan_.colors);
    SpoolFile spool(work_.file("buckets"));
    std::optional<Buckets> buckets;
    std::vector<uint64_t> sizes;
    uint64_t not_finite = 0;
    const auto fill_buckets = [&] {
      if (buckets) return;
      std::vector<LatticeTriangle> batch;
      buckets.emplace(
          [&](uint64_t every, const Buckets::Take& take) {
            uint64_t next = 0;  // index in the batch of the next one that is wanted
            not_finite = read_mesh(model_.meshes[mesh.mesh], [&](std::span<const CornerTriangle> triangles) {
              batch.clear();
              for (; next < triangles.size(); next += every) batch.push_back(to_lattice(triangles[next]));
              next -= triangles.size();
              take(batch);
            });
          },
          mesh.triangles, options_.bucket_triangles, spool);
    };
    // A unit of its own: where an earlier run finished all of the mesh, nothing is read again.
    work_.unit(
        [&](ByteWriter& record) {
          fill_buckets();
          record.write(not_finite);
          record.write(buckets->shared_points());
          record.write(uint64_t{buckets->count()});
          for (size_t i = 0; i < buckets->count(); ++i) record.write(buckets->triangles(i));
        },
        [&](ByteReader& record) {
          dropped_triangles += record.read<uint64_t>();
          border_counts[index] = record.read<uint32_t>();
          sizes = record.read_all<uint64_t>(record.read<uint64_t>());
        });
    const PartitionLimits part_limits = limits(mesh, mesh.triangles);
    for (uint32_t first = 0; first < sizes.size();) {
      const auto end = static_cast<uint32_t>(
          end_of_group(first, sizes.size(), unit_triangles_, [&](size_t bucket) { return sizes[bucket]; }));
      unit(
          end - first, fill_buckets,
          [&](uint32_t i) {
            Bucket bucket = buckets->load(first + i);
            const Welded welded = weld(bucket.triangles);
            bucket.triangles = {};
            return finish(mesh, welded, part_limits, bucket.shared, buckets->shared_points());
          },
          [&](uint32_t) { return index; });
      for (; first < end; ++first) progress.advance(sizes[first]);
    }
    std::error_code ignored;  // at the latest it goes with its folder
    std::filesystem::remove(spool.path(), ignored);
  }

  const Model& model_;
  const BuildPlan& plan_;
  const BuildOptions& options_;
  BuildWork& work_;
  const uint64_t unit_triangles_;
  double small_ = 0, large_ = 0;
};

}  // namespace

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

  // The parts of one mesh came one after the other.
  Parts parts;
  std::vector<uint32_t> first(plan.meshes.size() + 1, 0);
  for (const uint32_t mesh : maker.meshes) ++first[mesh + 1];
  for (size_t mesh = 0; mesh < plan.meshes.size(); ++mesh) first[mesh + 1] += first[mesh];
  std::vector<uint32_t> ordinals(plan.meshes.size(), 0);  // of the next instance of each mesh
  for (uint32_t i = 0; i < plan.instances.size(); ++i) {
    const PlannedInstance& instance = plan.instances[i];
    const uint32_t ordinal = ordinals[instance.mesh]++;
    parts.border_counts.push_back(maker.border_counts[instance.mesh]);
    for (uint32_t part = first[instance.mesh]; part < first[instance.mesh + 1]; ++part) {
      parts.placed.push_back({part, instance.transform, i});
      parts.boxes.push_back(maker.boxes[part][ordinal]);
    }
    if (first[instance.mesh + 1] > first[instance.mesh]) ++parts.instances;
  }
  if (parts.placed.empty()) fail(model.name(), "holds no triangle that has an area");
  parts.parts = std::move(maker.infos);
  parts.transforms = std::move(plan.transforms);
  parts.stretches = std::move(plan.stretches);
  parts.lattices = std::move(plan.lattices);
  parts.palette = std::move(plan.palette);
  return parts;
}

}  // namespace triptych
