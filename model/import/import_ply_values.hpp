// The records of a PLY file, in any encoding.
#pragma once

#include "base/error.hpp"
#include "model/import/import_file.hpp"
#include "model/import/import_ply_header.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace triptych {

/// Reads the values of records one after the other, in any encoding. Every type fits a double
/// exactly.
class PlyValues {
 public:
  PlyValues(ImportReader& reader, PlyEncoding encoding, std::string name)
      : reader_(reader), encoding_(encoding), name_(std::move(name)) {}

  /// ASCII is read word by word, as other readers do: a record may go over lines, and a line may hold
  /// several.
  void begin_record() {
    if (encoding_ == PlyEncoding::ascii) several_in_line_ = several_in_line_ || !trimmed(line_).empty();
  }

  /// After the last record: what is left. Error where records did not fit their lines and something is left:
  /// then lines hold values that the header does not name, and what was read is not what was meant.
  void finish(FileImport& target) {
    if (encoding_ != PlyEncoding::ascii)
      return target.warn("bytes after the last element were skipped", reader_.left());
    uint64_t lines = trimmed(line_).empty() ? 0 : 1;
    if (lines > 0) several_in_line_ = true;
    while (reader_.next_line(line_)) lines += trimmed(line_).empty() ? 0 : 1;
    if (lines > 0 && several_in_line_)
      fail(name_, "lines hold more values than their elements have properties ({} lines are left at the end)",
           lines);
    target.warn("lines after the last element were skipped", lines);
  }

  double read(PlyType type) {
    if (encoding_ == PlyEncoding::ascii) {
      while (trimmed(line_).empty()) {
        if (!reader_.next_line(line_)) fail(place(), "the file ends too soon");
      }
      const auto number = to_number(take_word(line_));
      if (!number) fail(place(), "a number is missing");
      return *number;
    }
    return load_scalar(reader_.read(scalar_bytes(type)).data(), type, encoding_ == PlyEncoding::big_endian);
  }

  /// A whole number from 0 to `limit`; anything else is an Error.
  uint64_t read_index(PlyType type, uint64_t limit, const char* what) {
    const double value = read(type);
    if (!(value >= 0 && value <= static_cast<double>(limit)) || value != std::floor(value)) {
      fail(place(), "{} is {}, and must be from 0 to {}", what, value, limit);
    }
    return static_cast<uint64_t>(value);
  }

  /// A vertex's number; nothing for -1, in an unsigned type its largest value.
  std::optional<uint32_t> read_vertex_or_end(PlyType type, uint64_t vertex_count) {
    const double value = read(type);
    const double largest = type == PlyType::uint8    ? 255
                           : type == PlyType::uint16 ? 65535
                           : type == PlyType::uint32 ? 4294967295
                                                     : -1;
    if (value == -1 || (value == largest && value >= static_cast<double>(vertex_count))) return std::nullopt;
    if (!(value >= 0 && value < static_cast<double>(vertex_count)) || value != std::floor(value))
      fail(place(), "a strip's vertex is {}, and must be from 0 to {}", value, vertex_count - 1);
    return static_cast<uint32_t>(value);
  }

  /// The length of a list, checked against what the file can still hold.
  uint64_t read_length(const PlyProperty& property) {
    const uint64_t smallest = encoding_ == PlyEncoding::ascii ? 1 : scalar_bytes(property.type);
    const uint64_t length =
        read_index(*property.count_type, std::numeric_limits<uint32_t>::max(), "a list's length");
    const uint64_t left = reader_.left() + (encoding_ == PlyEncoding::ascii ? line_.size() : 0);
    if (length > left / smallest) fail(place(), "the file ends within a list of {} values", length);
    return length;
  }

  void skip(const PlyProperty& property) {
    const uint64_t count = property.count_type ? read_length(property) : 1;
    for (uint64_t i = 0; i < count; ++i) read(property.type);
  }

  std::string place() const {
    return encoding_ == PlyEncoding::ascii ? reader_.line_place()
                                           : fmt::format("{}: byte {}", name_, reader_.offset());
  }

 private:
  ImportReader& reader_;
  PlyEncoding encoding_;
  std::string name_;
  std::string_view line_;
  bool several_in_line_ = false;  ///< whether a record began within a line
};

}  // namespace triptych
