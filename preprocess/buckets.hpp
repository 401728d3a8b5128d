// Triangles of a mesh that is too large for memory, sorted by place into buckets that fit (external
// partitioning as in Cignoni, Montani, Rocchini and Scopigno, External memory management and simplification
// of huge meshes, 2003).
#pragma once

#include "base/spool_file.hpp"
#include "preprocess/to_lattice.hpp"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace triptych {

/// A point that is in several buckets, or may be.
struct SharedPoint {
  glm::ivec3 point;
  uint32_t number;  ///< below Buckets::shared_points(), the same in every bucket
};

/// A bucket, read back: its triangles in their original order, and which points it may share with others.
struct Bucket {
  std::vector<LatticeTriangle> triangles;
  /// Sorted by place; every point that another bucket has too, and perhaps more.
  std::vector<SharedPoint> shared;
};

/// The point's number, if it is one of the shared ones, which are sorted.
std::optional<uint32_t> number_in(std::span<const SharedPoint> shared, const glm::ivec3& point);

/// Space split in half, and each half again, as the triangles are distributed.
class Buckets {
 public:
  using Take = std::function<void(std::span<const LatticeTriangle>)>;
  /// Reads every `every`-th triangle from the first on, in batches; the same ones each time.
  using Read = std::function<void(uint64_t every, const Take&)>;

  /// Reads twice (a sample, then all) and writes all triangles to the spool file, which must outlive this.
  /// `total`: how many triangles there are; `limit`: how many go into a bucket, about; more only where they
  /// all have one centre. Deterministic. Memory: 12 MB for the sample, 30 KB for each bucket, 12 bytes for
  /// each shared point. streams: what corners have; what follows the last of them is not kept.
  Buckets(const Read& read, uint64_t total, uint64_t limit, const CornerStreams& streams, SpoolFile& spool);

  size_t count() const { return places_.size(); }
  uint64_t triangles(size_t bucket) const;
  uint32_t shared_points() const { return first_number_.back(); }
  /// Safe on several threads.
  Bucket load(size_t bucket) const;

 private:
  struct Split {
    int axis = -1;                   ///< -1: a bucket
    int at = 0;                      ///< points with a smaller coordinate are on the first side
    uint32_t first = 0, second = 0;  ///< indices of splits; of a bucket: its number, unused
  };

  uint32_t split(std::span<glm::ivec3> sample, uint64_t limit);
  uint32_t bucket_of(const glm::ivec3& point) const;
  /// The number of a point that several buckets have.
  uint32_t number_of(const glm::ivec3& point) const;
  void distribute(const Read& read);

  std::vector<Split> splits_;  ///< a tree; 0 is its root
  size_t triangle_bytes_;      ///< in the file: the first bytes of a LatticeTriangle
  SpoolFile& spool_;
  std::vector<std::vector<SpoolPlace>> places_;   ///< for each bucket where its triangles lie
  std::vector<std::vector<glm::ivec3>> foreign_;  ///< for each bucket the points in its space that others use
  /// For each bucket the number of its first foreign point; last, their count.
  std::vector<uint32_t> first_number_;
};

}  // namespace triptych
