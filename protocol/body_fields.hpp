// The bytes of a message's body, field by field: one description of a message serves for writing and reading.
#pragma once

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "protocol/wire.hpp"

#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace triptych {

inline bool is_control(char character) {
  return static_cast<unsigned char>(character) < 0x20 || character == 0x7f;
}

inline void write_line(ByteWriter& out, const std::string& text) {
  std::string line = text.substr(0, text_limit);
  for (char& character : line) {
    if (is_control(character)) character = ' ';
  }
  out.write_text(line);
}

inline std::string read_line(ByteReader& in) {
  const std::string line = in.read_text();
  if (line.size() > text_limit) fail(in.place(), "a text of {} bytes", line.size());
  for (const char character : line) {
    if (is_control(character)) fail(in.place(), "a text with control characters");
  }
  return line;
}

inline void expect_not_negative(const ByteReader& in, double value, const char* what) {
  if (!std::isfinite(value) || value < 0) fail(in.place(), "{} is {}", what, value);
}

/// A floating-point number's bytes without the zero bytes at its lower end: round numbers have many.
struct ShortNumber {
  uint64_t bits;
  uint32_t bytes;
};

inline ShortNumber shorten(double number) {
  const auto bits = std::bit_cast<uint64_t>(number);
  return {bits, bits == 0 ? 0 : 8 - static_cast<uint32_t>(std::countr_zero(bits)) / 8};
}

/// How many bytes each has, four bits each, two to a byte; then those bytes, the lowest first.
inline void write_numbers(ByteWriter& out, std::span<const double* const> numbers) {
  for (size_t i = 0; i < numbers.size(); i += 2) {
    const uint32_t next = i + 1 < numbers.size() ? shorten(*numbers[i + 1]).bytes : 0;
    out.write(static_cast<uint8_t>(shorten(*numbers[i]).bytes | next << 4));
  }
  for (const double* number : numbers) {
    const ShortNumber shortened = shorten(*number);
    for (uint32_t byte = 8 - shortened.bytes; byte < 8; ++byte)
      out.write(static_cast<uint8_t>(shortened.bits >> (8 * byte)));
  }
}

inline void read_numbers(ByteReader& in, std::span<double* const> numbers) {
  std::vector<uint32_t> lengths;
  while (lengths.size() < numbers.size()) {
    const auto pair = in.read<uint8_t>();
    lengths.push_back(pair & 15u);
    lengths.push_back(pair >> 4u);
  }
  if (lengths.size() > numbers.size() && lengths.back() != 0) fail(in.place(), "a number too many");
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (lengths[i] > 8) fail(in.place(), "a number of {} bytes", lengths[i]);
    uint64_t bits = 0;
    for (uint32_t byte = 8 - lengths[i]; byte < 8; ++byte)
      bits |= static_cast<uint64_t>(in.read<uint8_t>()) << (8 * byte);
    *numbers[i] = std::bit_cast<double>(bits);
    if (shorten(*numbers[i]).bytes != lengths[i]) fail(in.place(), "a number with a needless byte");
  }
}

/// A position in the bytes of a message: a BodyWriter writes the fields that it is given, a BodyReader reads
/// them. So one description of a message serves both.
class BodyWriter {
 public:
  static constexpr bool reads = false;
  explicit BodyWriter(ByteWriter& out) : out_(out) {}

  template <typename Value>
  void plain(const Value& value) {
    out_.write(value);
  }
  /// One byte; `largest` is the last valid value.
  template <typename Enum>
  void choice(const Enum& value, Enum /*largest*/, const char* /*what*/) {
    out_.write(static_cast<uint8_t>(value));
  }
  void line(const std::string& text) { write_line(out_, text); }
  void count(uint32_t value) { out_.write_varint(value); }
  void count(uint64_t value) { out_.write_varint(value); }
  void numbers(std::span<const double* const> numbers) { write_numbers(out_, numbers); }
  /// Milliseconds, not negative.
  void times(std::initializer_list<const double*> times) { numbers({times.begin(), times.size()}); }
  void rest(const std::vector<std::byte>& bytes) { out_.write_all(std::span<const std::byte>(bytes)); }

 private:
  ByteWriter& out_;
};

class BodyReader {
 public:
  static constexpr bool reads = true;
  explicit BodyReader(ByteReader& in) : in_(in) {}

  template <typename Value>
  void plain(Value& value) {
    value = in_.read<Value>();
  }
  template <typename Enum>
  void choice(Enum& value, Enum largest, const char* what) {
    const auto read = in_.read<uint8_t>();
    if (read > static_cast<uint8_t>(largest)) fail(place(), "{} {} does not exist", what, read);
    value = static_cast<Enum>(read);
  }
  void line(std::string& text) { text = read_line(in_); }
  void count(uint32_t& value) {
    const uint64_t read = in_.read_varint();
    if (read > std::numeric_limits<uint32_t>::max()) fail(place(), "a count of {}", read);
    value = static_cast<uint32_t>(read);
  }
  void count(uint64_t& value) { value = in_.read_varint(); }
  void numbers(std::span<double* const> numbers) { read_numbers(in_, numbers); }
  void times(std::initializer_list<double*> times) {
    numbers({times.begin(), times.size()});
    for (const double* time : times) expect_not_negative(in_, *time, "a time");
  }
  void rest(std::vector<std::byte>& bytes) { bytes = in_.read_all<std::byte>(in_.left()); }

  ByteReader& bytes() { return in_; }
  const std::string& place() const { return in_.place(); }

 private:
  ByteReader& in_;
};

}  // namespace triptych
