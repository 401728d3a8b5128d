// Little-endian bytes in and out, bounds-checked: the pack and the protocol are written with these.
#pragma once

#include "base/error.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace triptych {

static_assert(std::endian::native == std::endian::little, "packs and messages are little-endian");

/// Appends plain values to a byte vector.
class ByteWriter {
 public:
  template <typename Value>
  void write(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    write_all(std::span(&value, 1));
  }

  /// Only the values, without a count.
  template <typename Value>
  void write_all(std::span<const Value> values) {
    append(std::as_bytes(values));
  }

  /// A 32-bit length, then the characters.
  void write_text(const std::string& text) {
    write(static_cast<uint32_t>(text.size()));
    write_all(std::span<const char>(text));
  }

  /// An unsigned integer in groups of seven bits, lowest first (LEB128): at most 10 bytes.
  void write_varint(uint64_t value) {
    for (; value >= 0x80; value >>= 7) bytes_.push_back(static_cast<std::byte>(value | 0x80));
    bytes_.push_back(static_cast<std::byte>(value));
  }

  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  // Not inlined: g++ 12 sees overflows in vectors that grow where there are none.
  [[gnu::noinline]] void append(std::span<const std::byte> added) {
    bytes_.insert(bytes_.end(), added.begin(), added.end());
  }

  std::vector<std::byte> bytes_;
};

/// Reads plain values; Error with the place and the byte offset if they end too soon.
class ByteReader {
 public:
  ByteReader(std::span<const std::byte> bytes, std::string place) : bytes_(bytes), place_(std::move(place)) {}

  template <typename Value>
  Value read() {
    static_assert(std::is_trivially_copyable_v<Value>);
    Value value;
    std::memcpy(&value, take(sizeof(Value)).data(), sizeof(Value));
    return value;
  }

  /// `count` values; the count is checked against what is left before anything is allocated.
  template <typename Value>
  std::vector<Value> read_all(uint64_t count) {
    if (count > left() / sizeof(Value))
      fail(place_, "byte {}: {} values declared, {} bytes left", offset_, count, left());
    std::vector<Value> values(static_cast<size_t>(count));
    const auto bytes = take(values.size() * sizeof(Value));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  std::string read_text() {
    const auto characters = read_all<char>(read<uint32_t>());
    return {characters.begin(), characters.end()};
  }

  uint64_t read_varint() {
    uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto group = read<uint8_t>();
      if (shift == 63 && group > 1) break;
      value |= static_cast<uint64_t>(group & 0x7f) << shift;
      if (group < 0x80) return value;
    }
    fail(place_, "byte {}: a number of more than 64 bits", offset_);
  }

  /// An Error unless every byte was read.
  void expect_end() const {
    if (left() != 0) fail(place_, "byte {}: {} bytes too many", offset_, left());
  }

  size_t left() const { return bytes_.size() - offset_; }
  size_t offset() const { return offset_; }
  const std::string& place() const { return place_; }

 private:
  std::span<const std::byte> take(size_t count) {
    if (count > left()) fail(place_, "byte {}: ends too soon, {} more bytes needed", offset_, count - left());
    const auto taken = bytes_.subspan(offset_, count);
    offset_ += count;
    return taken;
  }

  std::span<const std::byte> bytes_;
  std::string place_;
  size_t offset_ = 0;
};

}  // namespace triptych
