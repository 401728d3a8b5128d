#include "protocol/range_coder.hpp"

namespace triptych {

namespace {
constexpr uint32_t min_range = 1u << 24;
}

void BitModel::learn(bool bit) {
  seen_ = std::min(seen_ + 1, slowest);
  if (bit) {
    zero_ -= (zero_ - min_zero) / seen_;
  } else {
    zero_ += (max_zero - zero_) / seen_;
  }
}

void RangeEncoder::encode(BitModel& model, bool bit) {
  const uint32_t zeros = (range_ >> 16) * model.zero();
  if (bit) {
    narrow(zeros, range_ - zeros);
  } else {
    narrow(0, zeros);
  }
  model.learn(bit);
}

void RangeEncoder::encode_even(uint32_t value, int count) {
  while (count-- > 0) narrow(value >> count & 1 ? range_ >> 1 : 0, range_ >> 1);
}

void RangeEncoder::narrow(uint32_t skipped, uint32_t range) {
  const bool carry = low_ + skipped < low_;
  low_ += skipped;
  range_ = range;
  if (carry) {
    auto byte = bytes_.rbegin();
    for (; *byte == std::byte{0xff}; ++byte) *byte = std::byte{0};
    *byte = static_cast<std::byte>(std::to_integer<int>(*byte) + 1);
  }
  for (; range_ < min_range; range_ <<= 8) {
    bytes_.push_back(static_cast<std::byte>(low_ >> 24));
    low_ <<= 8;
  }
}

std::vector<std::byte> RangeEncoder::finish() {
  // The number in [low, low + range) with the most zeros at its end; range ≥ 2²⁴, so one byte is always
  // enough.
  constexpr uint32_t tail = min_range - 1;
  if (low_ != 0) {
    narrow((tail - ((low_ - 1) & tail)), min_range);
    bytes_.push_back(static_cast<std::byte>(low_ >> 24));
  }
  return std::move(bytes_);
}

RangeDecoder::RangeDecoder(std::span<const std::byte> bytes) : bytes_(bytes) {
  for (int i = 0; i < 4; ++i) {
    code_ = code_ << 8 | (position_ < bytes_.size() ? std::to_integer<uint32_t>(bytes_[position_]) : 0);
    ++position_;
  }
}

bool RangeDecoder::decode(BitModel& model) {
  const uint32_t zeros = (range_ >> 16) * model.zero();
  const bool bit = code_ >= zeros;
  if (bit) {
    narrow(zeros, range_ - zeros);
  } else {
    narrow(0, zeros);
  }
  model.learn(bit);
  return bit;
}

uint32_t RangeDecoder::decode_even(int count) {
  uint32_t value = 0;
  for (; count > 0; --count) {
    const uint32_t half = range_ >> 1;
    const bool bit = code_ >= half;
    narrow(bit ? half : 0, half);
    value = value << 1 | bit;
  }
  return value;
}

void RangeDecoder::narrow(uint32_t skipped, uint32_t range) {
  code_ -= skipped;
  range_ = range;
  for (; range_ < min_range; range_ <<= 8) {
    code_ = code_ << 8 | (position_ < bytes_.size() ? std::to_integer<uint32_t>(bytes_[position_]) : 0);
    ++position_;
  }
}

}  // namespace triptych
