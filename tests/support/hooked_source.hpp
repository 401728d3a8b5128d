// The bytes of a file in memory, read as slowly, or as badly, as a test wants.
#pragma once

#include "scene/byte_source.hpp"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <vector>

namespace triptych::test {

class HookedSource final : public ByteSource {
 public:
  explicit HookedSource(const std::filesystem::path& file, Habits habits = {})
      : name_(file.string()), habits_(habits) {
    std::ifstream in(file, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::string& name() const override { return name_; }
  uint64_t size() const override { return bytes_.size(); }
  void read(uint64_t offset, std::span<std::byte> into, const std::string& place) const override {
    ++reads;
    if (before) before(place);
    std::copy_n(std::as_bytes(std::span(bytes_)).begin() + static_cast<std::ptrdiff_t>(offset), into.size(),
                into.begin());
  }
  Habits habits() const override { return habits_; }

  mutable std::atomic<uint64_t> reads{0};
  /// Called with the place of each read, which it may delay, or refuse by an Error. Set before reads begin.
  std::function<void(const std::string& place)> before;

 private:
  std::string name_;
  Habits habits_;
  std::vector<char> bytes_;
};

}  // namespace triptych::test
