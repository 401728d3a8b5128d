// The triangles around a point of a surface, in the order in which they are connected.
#pragma once

#include "simplify/shrinking_mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// The star of a point, divided into fans: triangles of one material that are connected by shared edges,
/// whichever way they are turned. Where more than two meet at an edge, the flattest pairs are connected; two
/// that cover each other (the sides of a sheet) never are. Where a texture has a seam, a fan ends.
class Star {
 public:
  /// Points with more triangles are not collapsed until they have fewer: ordering takes time with the square
  /// of their number.
  static constexpr size_t max_spokes = 48;

  struct Fan {
    size_t begin, end;  ///< of spokes(); each one's `to` is the next one's `from`
    bool closed;        ///< the last one's `to` is the first one's `from`
  };

  /// Reads the star of the point; false if it has no triangle, or too many.
  bool read(ShrinkingMesh& mesh, uint32_t point);

  /// Fan after fan; `from` and `to` may be swapped.
  std::span<const Spoke> spokes() const { return spokes_; }
  std::span<const Fan> fans() const { return fans_; }
  /// How many triangles are beyond the second at the edges to points of higher index.
  size_t crowd() const { return crowd_; }

 private:
  /// An end of a spoke: twice its index, one more for `to`.
  using End = uint32_t;
  static constexpr End none = 0xffffffffu;

  struct KeyedEnd {
    uint64_t key;  ///< its corner and material
    uint32_t triangle;
    End end;
  };

  bool order_single();
  bool chain_before(size_t chained);
  bool corners_differ() const;
  void order_fans(const ShrinkingMesh& mesh, uint32_t point);
  void join_ends(const ShrinkingMesh& mesh, uint32_t point);
  void join_flattest(const ShrinkingMesh& mesh, uint32_t point, std::span<const End> ends);
  void follow(End end, bool closed);
  void split_at_seams(const ShrinkingMesh& mesh, uint32_t point);
  uint32_t corner(End end) const { return end & 1 ? spokes_[end / 2].to : spokes_[end / 2].from; }

  std::vector<Spoke> spokes_, ordered_;
  std::vector<Fan> fans_, whole_;
  std::vector<KeyedEnd> keyed_;
  std::vector<End> mates_, ends_;
  std::vector<uint8_t> done_;
  size_t crowd_ = 0;
};

}  // namespace triptych
