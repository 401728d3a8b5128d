// Arithmetic coding of bits whose probabilities are learned on the way, after G. N. N. Martin, "Range
// encoding", 1979, with carries as in I. Pavlov's LZMA.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// How likely a bit of one kind is 0; it learns fast at first, as messages are short.
class BitModel {
 public:
  /// Expects `zeros` zeros among `total` bits; trust: how many observed bits that expectation is worth.
  constexpr explicit BitModel(uint64_t zeros = 1, uint64_t total = 2, uint32_t trust = 1)
      : zero_(std::clamp(static_cast<uint32_t>((zeros << 16) / total), min_zero, max_zero)), seen_(trust) {}

  /// Of 65536; never so close to either end that a bit costs nothing.
  uint32_t zero() const { return zero_; }
  void learn(bool bit);

 private:
  static constexpr uint32_t min_zero = 128, max_zero = 65536 - min_zero, slowest = 40;
  uint32_t zero_, seen_;
};

class RangeEncoder {
 public:
  void encode(BitModel& model, bool bit);
  /// The low `count` bits of value, each as likely 0 as 1.
  void encode_even(uint32_t value, int count);
  /// The bytes: as few as the decoder needs, which reads zeros after the end.
  std::vector<std::byte> finish();

 private:
  void narrow(uint32_t skipped, uint32_t range);
  std::vector<std::byte> bytes_;
  uint32_t low_ = 0, range_ = 0xffffffff;
};

class RangeDecoder {
 public:
  explicit RangeDecoder(std::span<const std::byte> bytes);
  bool decode(BitModel& model);
  uint32_t decode_even(int count);
  /// Whether more was decoded than any encoder can have put into these bytes.
  bool overran() const { return position_ > bytes_.size() + 4; }

 private:
  void narrow(uint32_t skipped, uint32_t range);
  std::span<const std::byte> bytes_;
  size_t position_ = 0;
  uint32_t code_ = 0, range_ = 0xffffffff;
};

}  // namespace triptych
