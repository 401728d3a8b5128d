#include "preprocess/sorted_mesh.hpp"

#include "model/read_mesh.hpp"

namespace triptych {

SortedMesh::SortedMesh(const Mesh& mesh, const ToLattice& to_lattice, uint32_t bucket_triangles,
                       const std::filesystem::path& file)
    : mesh_(mesh), to_lattice_(to_lattice), bucket_triangles_(bucket_triangles), spool_(file) {}

SortedMesh::~SortedMesh() {
  std::error_code ignored;  // otherwise it is removed with its folder
  std::filesystem::remove(spool_.path(), ignored);
}

const Buckets& SortedMesh::buckets() {
  std::call_once(sorted_, [&] {
    std::vector<LatticeTriangle> batch;
    const KeptCorners kept = mesh_.has_coordinates() ? KeptCorners::colors_and_coordinates
                             : mesh_.has_colors()    ? KeptCorners::colors
                                                     : KeptCorners::points;
    buckets_.emplace(
        [&](uint64_t every, const Buckets::Take& take) {
          uint64_t next = 0;  // index in the batch of the next triangle to keep
          not_finite_ = read_mesh(mesh_, [&](std::span<const CornerTriangle> triangles) {
            batch.clear();
            for (; next < triangles.size(); next += every) batch.push_back(to_lattice_(triangles[next]));
            next -= triangles.size();
            take(batch);
          });
        },
        mesh_.triangle_count(), bucket_triangles_, kept, spool_);
  });
  return *buckets_;
}

UnitResult SortedMesh::unit() {
  SortFigures figures;
  for (size_t i = 0; i < buckets().count(); ++i) figures.bucket_triangles.push_back(buckets().triangles(i));
  figures.not_finite = not_finite_;
  figures.shared_points = buckets().shared_points();
  return {{}, {}, record_bytes(figures)};
}

}  // namespace triptych
