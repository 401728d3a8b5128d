// A mesh that is too large for memory, as buckets that are not.
#pragma once

#include "model/model.hpp"
#include "preprocess/buckets.hpp"
#include "preprocess/build_unit.hpp"

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <vector>

namespace triptych {

struct SortFigures {
  uint64_t not_finite = 0;                 ///< triangles in no bucket, since a corner is not finite
  uint32_t shared_points = 0;              ///< Buckets::shared_points()
  std::vector<uint64_t> bucket_triangles;  ///< for each bucket
};
template <>
inline constexpr auto record_members<SortFigures> = std::tuple(&SortFigures::not_finite,
                                                               &SortFigures::shared_points,
                                                               &SortFigures::bucket_triangles);

/// The mesh is read and sorted when its buckets are first used; never, if an earlier run divided all of them.
/// This object owns the file that they lie in and removes it.
class SortedMesh {
 public:
  /// `file` is written; the mesh and the colours of `to_lattice` must outlive this.
  SortedMesh(const Mesh& mesh, const ToLattice& to_lattice, uint32_t bucket_triangles,
             const std::filesystem::path& file);
  ~SortedMesh();

  /// Safe on several threads.
  const Buckets& buckets();
  /// The unit UnitKind::sorted_mesh; its figures are SortFigures.
  UnitResult unit();

 private:
  const Mesh& mesh_;
  ToLattice to_lattice_;
  uint32_t bucket_triangles_;
  SpoolFile spool_;
  std::once_flag sorted_;
  std::optional<Buckets> buckets_;
  uint64_t not_finite_ = 0;
};

}  // namespace triptych
