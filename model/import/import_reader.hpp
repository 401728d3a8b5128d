// A model file read from front to back, by lines or by bytes, in blocks: a file of any size takes little
// memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
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
  ~ImportReader();
  ImportReader(const ImportReader&) = delete;
  ImportReader& operator=(const ImportReader&) = delete;

  /// The next line without its end (\n or \r\n), valid until the next read; false at the end of the file.
  /// Error for a line of more than 64 MiB.
  bool next_line(std::string_view& line);
  /// The next `count` bytes, valid until the next read. Error (file, byte) if the file ends before.
  std::span<const std::byte> read(size_t count);

  template <typename Value>
  Value read_value() {
    Value value;
    std::memcpy(&value, read(sizeof(Value)).data(), sizeof(Value));
    return value;
  }

  uint64_t size() const { return size_; }
  uint64_t offset() const { return offset_; }  ///< bytes read so far
  uint64_t left() const { return size_ - offset_; }
  uint64_t line() const { return line_; }  ///< number of the last line read, from 1
  std::string line_place() const;          ///< "<file>: line 12"

 private:
  bool refill();  ///< reads more behind what is not consumed yet; false at the end of the file

  std::string name_;
  std::FILE* file_ = nullptr;
  uint64_t size_ = 0, offset_ = 0, line_ = 0;
  std::vector<char> buffer_;
  size_t begin_ = 0, end_ = 0;
};

/// Takes the next word (up to a blank) off the front of the text; empty where there is none.
std::string_view take_word(std::string_view& text);
/// The text without blanks at either end.
std::string_view trimmed(std::string_view text);
/// A number that fills the whole word, "nan" and "inf" included; one too large for a double is infinite.
std::optional<double> to_number(std::string_view word);
std::optional<int64_t> to_integer(std::string_view word);

}  // namespace triptych
