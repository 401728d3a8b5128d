// A DXF file, text or binary, as records: what begins with group code 0, and the groups up to the next one.
#pragma once

#include "model/import/import_reader.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// A group code and its value. Groups of numbers have no text, those of text no number.
struct DxfGroup {
  int code = 0;
  double number = 0;  ///< NaN where the file holds no number
  std::string text;

  /// The number without its fraction; `otherwise` where the file holds no number, or one beyond 10^15.
  int64_t integer(int64_t otherwise) const;
};

struct DxfRecord {
  std::string type;  ///< the text of group 0: "SECTION", "3DFACE" ...
  std::vector<DxfGroup> groups;
  uint64_t place = 0;  ///< line, or byte of a binary file

  /// The first value of a code; `otherwise` where there is none, or it is not finite.
  double number(int code, double otherwise = 0) const;
  /// The same, but NaN where the file holds no number: triangles with such a corner are dropped and counted.
  double coordinate(int code) const;
  int64_t integer(int code, int64_t otherwise = 0) const;
  std::string_view text(int code) const;
  bool has(int code) const;
};

class DxfReader {
 public:
  explicit DxfReader(std::shared_ptr<const StreamSource> source);

  /// The next record; false at the end of the file. Extended data (codes from 1000) and comments are left
  /// out. Error (place) if the file is no DXF, or a binary one ends within a group.
  bool next(DxfRecord& record);
  /// Lines where a group code was expected and something else stood; they were skipped.
  uint64_t skipped_lines() const { return skipped_lines_; }
  const char* unit_of_place() const { return binary_ ? "byte" : "line"; }

 private:
  bool next_group(DxfGroup& group);
  bool next_text_group(DxfGroup& group);
  bool next_binary_group(DxfGroup& group);
  std::string read_text();

  ImportReader reader_;
  bool binary_ = false, wide_codes_ = false;
  DxfGroup pending_;  ///< the group 0 that ended the last record
  bool has_pending_ = false;
  uint64_t skipped_lines_ = 0;
};

}  // namespace triptych
