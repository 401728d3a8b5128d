// A model file read from front to back, by lines or by bytes, in blocks: a file of any size takes little
// memory.
#pragma once

#include "model/import/mesh_stream_source.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

class ImportReader {
 public:
  /// Error (the path) if the file cannot be opened or is not a regular file.
  explicit ImportReader(const std::filesystem::path& file);
  /// Reads a source from its beginning.
  explicit ImportReader(std::shared_ptr<const StreamSource> source);

  /// The next line without its end, valid until the next read; false at the end of the file. A line ends with
  /// \n, \r\n or \r alone; a UTF-8 byte order mark before the first one is passed over. Error for UTF-16, and
  /// for a line of more than 64 MiB.
  bool next_line(std::string_view& line);
  /// The next `count` bytes, valid until the next read. Error (file, byte) if the file ends before.
  std::span<const std::byte> read(size_t count);

  template <typename Value>
  Value read_value() {
    Value value;
    std::memcpy(&value, read(sizeof(Value)).data(), sizeof(Value));
    return value;
  }

  const std::string& name() const { return reader_.source().name(); }
  uint64_t size() const { return reader_.source().size(); }
  uint64_t offset() const { return offset_; }  ///< bytes read so far
  uint64_t left() const { return size() - offset_; }
  uint64_t line() const { return line_; }  ///< number of the last line read, from 1
  std::string line_place() const;          ///< "<file>: line 12"

 private:
  bool refill();  ///< reads more behind what is not consumed yet; false at the end of the file
  void pass_mark();
  void consume(size_t count);

  SourceReader reader_;
  uint64_t offset_ = 0, line_ = 0;
  std::vector<char> buffer_;
  size_t begin_ = 0, end_ = 0;  ///< of what is in the buffer and not consumed
  /// Where the next \n and \r in the buffer are; those before `begin_` are out of date. Kept so that neither
  /// is searched for twice, whichever of them ends the lines.
  struct Found {
    size_t at = 0;        ///< the first one at or after begin_, if it is below `searched`
    size_t searched = 0;  ///< up to here
  };
  size_t find(Found& found, char letter);
  Found newline_, carriage_return_;
  bool newlines_ = false, lone_returns_ = false;  ///< whether a line has ended so
};

/// Takes the next word (up to a blank) off the front of the text; empty where there is none.
std::string_view take_word(std::string_view& text);
/// The text without blanks at either end.
std::string_view trimmed(std::string_view text);
/// A number that fills the whole word, "nan" and "inf" included; one too large for a double is infinite.
std::optional<double> to_number(std::string_view word);
std::optional<int64_t> to_integer(std::string_view word);

}  // namespace triptych
