#include "model/import/import_dxf_reader.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace triptych {

namespace {

constexpr std::string_view binary_sentinel("AutoCAD Binary DXF\r\n\x1a\0", 22);
constexpr int comment = 999, last_code = 1071;

enum class Kind { text, real, int16, int32, int64, flag, bytes };

/// What a group code's value is (DXF Reference, "Group Code Value Types").
Kind kind_of(int code) {
  struct Range {
    int first, last;
    Kind kind;
  };
  static constexpr Range ranges[] = {
      {10, 59, Kind::real},      {60, 79, Kind::int16},    {90, 99, Kind::int32},
      {110, 149, Kind::real},    {160, 169, Kind::int64},  {170, 179, Kind::int16},
      {210, 239, Kind::real},    {270, 289, Kind::int16},  {290, 299, Kind::flag},
      {310, 319, Kind::bytes},   {370, 389, Kind::int16},  {400, 409, Kind::int16},
      {420, 429, Kind::int32},   {440, 459, Kind::int32},  {460, 469, Kind::real},
      {1004, 1004, Kind::bytes}, {1010, 1059, Kind::real}, {1060, 1070, Kind::int16},
      {1071, 1071, Kind::int32}};
  for (const Range& range : ranges) {
    if (code >= range.first && code <= range.last) return range.kind;
  }
  return Kind::text;
}

bool is_dxf_binary(const std::shared_ptr<const StreamSource>& source) {
  if (source->size() < binary_sentinel.size() + 4) return false;
  std::string beginning(binary_sentinel.size(), ' ');
  SourceReader(source).read(0, std::as_writable_bytes(std::span(beginning)));
  return beginning == binary_sentinel;
}

}  // namespace

double DxfRecord::number(int code, double otherwise) const {
  for (const DxfGroup& group : groups) {
    if (group.code == code) return std::isfinite(group.number) ? group.number : otherwise;
  }
  return otherwise;
}

double DxfRecord::coordinate(int code) const {
  for (const DxfGroup& group : groups) {
    if (group.code == code) return group.number;
  }
  return 0;
}

int64_t DxfGroup::integer(int64_t otherwise) const {
  return std::abs(number) < 1e15 ? static_cast<int64_t>(number) : otherwise;
}

int64_t DxfRecord::integer(int code, int64_t otherwise) const {
  for (const DxfGroup& group : groups) {
    if (group.code == code) return group.integer(otherwise);
  }
  return otherwise;
}

std::string_view DxfRecord::text(int code) const {
  for (const DxfGroup& group : groups) {
    if (group.code == code) return group.text;
  }
  return {};
}

bool DxfRecord::has(int code) const {
  return std::any_of(groups.begin(), groups.end(), [&](const DxfGroup& group) { return group.code == code; });
}

DxfReader::DxfReader(std::shared_ptr<const StreamSource> source) : reader_(source) {
  binary_ = is_dxf_binary(source);
  if (!binary_) return;
  // Codes have one byte up to release 12: what follows the first code, 0, is "SECTION" or a comment.
  const auto beginning = reader_.read(binary_sentinel.size());
  (void)beginning;
  std::array<std::byte, 2> first{};
  SourceReader(source).read(binary_sentinel.size(), first);
  wide_codes_ = first[1] == std::byte{0} || first[1] == std::byte{3};  // 0 and 999 in two bytes
}

bool DxfReader::next(DxfRecord& record) {
  DxfGroup group;
  if (!has_pending_) {  // before the first record
    do {
      if (!next_group(pending_)) return false;
    } while (pending_.code != 0);
  }
  has_pending_ = false;
  record.type = pending_.text;
  record.groups.clear();
  record.place = binary_ ? reader_.offset() : reader_.line();
  while (next_group(group)) {
    if (group.code == 0) {
      pending_ = std::move(group);
      has_pending_ = true;
      break;
    }
    if (group.code < comment) record.groups.push_back(group);
  }
  return true;
}

bool DxfReader::next_group(DxfGroup& group) {
  return binary_ ? next_binary_group(group) : next_text_group(group);
}

bool DxfReader::next_text_group(DxfGroup& group) {
  std::string_view line;
  for (;;) {
    if (!reader_.next_line(line)) return false;
    const auto code = to_integer(trimmed(line));
    if (code && *code >= -5 && *code <= last_code) {
      group.code = static_cast<int>(*code);
      break;
    }
    if (!trimmed(line).empty()) ++skipped_lines_;
  }
  if (!reader_.next_line(line)) return false;
  group.text.clear();
  group.number = 0;
  const Kind kind = kind_of(group.code);
  if (kind == Kind::text) {
    group.text = trimmed(line);
  } else if (kind != Kind::bytes) {
    group.number = to_number(trimmed(line)).value_or(std::numeric_limits<double>::quiet_NaN());
  }
  return true;
}

std::string DxfReader::read_text() {
  std::string text;
  while (reader_.left() > 0) {
    const char letter = reader_.read_value<char>();
    if (letter == '\0') return text;
    text += letter;
  }
  return text;
}

bool DxfReader::next_binary_group(DxfGroup& group) {
  if (reader_.left() < (wide_codes_ ? 2u : 1u)) return false;
  if (wide_codes_) {
    group.code = reader_.read_value<int16_t>();
  } else {
    group.code = reader_.read_value<uint8_t>();
    if (group.code == 255) group.code = reader_.read_value<int16_t>();  // extended data
  }
  if (group.code < -5 || group.code > last_code)
    fail(fmt::format("{}: byte {}", reader_.name(), reader_.offset()), "{} is no group code of binary DXF",
         group.code);
  group.text.clear();
  group.number = 0;
  switch (kind_of(group.code)) {
    case Kind::text:
      group.text = read_text();
      break;
    case Kind::real:
      group.number = reader_.read_value<double>();
      break;
    case Kind::int16:
      group.number = reader_.read_value<int16_t>();
      break;
    case Kind::int32:
      group.number = reader_.read_value<int32_t>();
      break;
    case Kind::int64:
      group.number = static_cast<double>(reader_.read_value<int64_t>());
      break;
    case Kind::flag:
      group.number = reader_.read_value<uint8_t>();
      break;
    case Kind::bytes:
      reader_.read(reader_.read_value<uint8_t>());
      break;
  }
  return true;
}

}  // namespace triptych
