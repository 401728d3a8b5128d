// One number of 32 bits for each pixel of a picture.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Rows from bottom to top. Behind each row is room for a vector, which holds nothing of the picture, so that
/// vectors may begin at any pixel; and rows begin where cache lines do, an odd number of these apart, so that
/// those above each other do not compete for the same places in the processor's caches.
class PixelPlane {
 public:
  PixelPlane() = default;
  PixelPlane(int width, int height)
      : width_(width), height_(height), stride_(((width + line - 1) / line + 1) * line) {
    if (stride_ / line % 2 == 0) stride_ += line;
    words_.resize(static_cast<size_t>(stride_) * static_cast<size_t>(height) + line);
  }

  bool empty() const { return words_.empty(); }
  int width() const { return width_; }
  int height() const { return height_; }
  /// From a pixel to the one above.
  int stride() const { return stride_; }
  uint32_t* data() { return words_.data() + to_line(); }
  const uint32_t* data() const { return words_.data() + to_line(); }
  uint32_t& at(int x, int y) { return data()[index(x, y)]; }
  uint32_t at(int x, int y) const { return data()[index(x, y)]; }
  std::span<uint32_t> row(int y) { return {data() + index(0, y), static_cast<size_t>(width_)}; }
  std::span<const uint32_t> row(int y) const { return {data() + index(0, y), static_cast<size_t>(width_)}; }
  void clear() { std::fill(words_.begin(), words_.end(), 0u); }

 private:
  static constexpr int line = 16;  ///< words of a cache line, and of the widest vector

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(stride_) + static_cast<size_t>(x);
  }
  size_t to_line() const {
    const auto address = reinterpret_cast<uintptr_t>(words_.data()) / sizeof(uint32_t);
    return (line - address % line) % line;
  }

  int width_ = 0, height_ = 0, stride_ = 0;
  std::vector<uint32_t> words_;
};

}  // namespace triptych
