#include "raster/kernel_triangles.hpp"

namespace triptych {

namespace {
constexpr size_t fragments_each = 4;
constexpr size_t spare_fragments = 16, spare_numbers = 16;  ///< what a vector has beyond the last one
}  // namespace

SetUpResult KernelTriangles::begin(size_t count) {
  const size_t blocks = (count + NarrowTriangles::count - 1) / NarrowTriangles::count;
  if (wide_.size() < count) wide_.resize(count);
  if (layered_.size() < count + spare_numbers) layered_.resize(count + spare_numbers);
  if (narrow_.size() < blocks) narrow_.resize(blocks);
  if (fragments_.size() < 3 * (fragments_each * count + spare_fragments))
    fragments_.resize(3 * (fragments_each * count + spare_fragments));
  return {.blocks = narrow_.data(),
          .fragments = fragments(),
          .wide = wide_.data(),
          .rest = nullptr,
          .layered = layered_.data(),
          .block_count = 0,
          .fragment_count = 0,
          .wide_count = 0,
          .rest_count = 0,
          .layered_count = 0,
          .lowest_row = 0,
          .highest_row = -1};
}

void KernelTriangles::keep(const SetUpResult& made) {
  narrow_count_ = static_cast<size_t>(made.block_count);
  wide_count_ = static_cast<size_t>(made.wide_count);
  fragment_count_ = made.fragment_count;
}

void KernelTriangles::clear() {
  narrow_count_ = wide_count_ = 0;
  fragment_count_ = 0;
}

Fragments KernelTriangles::fragments() const {
  const size_t each = fragments_.size() / 3;
  return {fragments_.data(), fragments_.data() + each, fragments_.data() + 2 * each};
}

}  // namespace triptych
