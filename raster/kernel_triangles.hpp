// What kernels make of a stretch of triangles.
#pragma once

#include "raster/simd/kernels.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// What kernels make of most triangles: numbers side by side, and single pixels. Keeps its room.
class KernelTriangles {
 public:
  /// None yet; room for what so many candidates become.
  SetUpResult begin(size_t count);
  void keep(const SetUpResult& made);
  void clear();

  std::span<const NarrowTriangles> narrow() const { return {narrow_.data(), narrow_count_}; }
  std::span<const FillTriangle> wide() const { return {wide_.data(), wide_count_}; }
  Fragments fragments() const;
  int32_t fragment_count() const { return fragment_count_; }

 private:
  std::vector<NarrowTriangles> narrow_;
  mutable std::vector<uint32_t> fragments_;  ///< three arrays, one behind the other
  std::vector<FillTriangle> wide_;
  std::vector<uint32_t> layered_;
  size_t narrow_count_ = 0, wide_count_ = 0;
  int32_t fragment_count_ = 0;
};

}  // namespace triptych
