#include "model/import/import_reader.hpp"

#include "base/descriptor.hpp"
#include "base/error.hpp"
#include "base/file_access.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <locale.h>
#include <stdlib.h>

namespace triptych {

namespace {
constexpr size_t block_bytes = size_t{1} << 18;
constexpr size_t max_line_bytes = size_t{64} << 20;

bool is_blank(char letter) {
  return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\v' || letter == '\f';
}
}  // namespace

ImportReader::ImportReader(const std::filesystem::path& file)
    : name_(file.string()), file_(::fdopen(open_to_read(file).release(), "rb")) {
  if (!file_) fail(name_, "cannot be opened: {}", std::strerror(errno));
  size_ = size_of(::fileno(file_), name_);
}

ImportReader::~ImportReader() { std::fclose(file_); }

bool ImportReader::refill() {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (buffer_.size() < end_ + block_bytes) buffer_.resize(std::max(end_ + block_bytes, buffer_.size() * 2));
  const size_t count = std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_);
  if (std::ferror(file_)) fail(name_, "cannot be read: {}", std::strerror(errno));
  end_ += count;
  return count > 0;
}

bool ImportReader::next_line(std::string_view& line) {
  for (size_t searched = 0;;) {
    const char* first = buffer_.data() + begin_;
    const size_t available = end_ - begin_;
    const void* found =
        searched < available ? std::memchr(first + searched, '\n', available - searched) : nullptr;
    const size_t length = found ? static_cast<size_t>(static_cast<const char*>(found) - first) : available;
    if (length > max_line_bytes) fail(fmt::format("{}: line {}", name_, line_ + 1), "is longer than 64 MiB");
    if (!found) {
      searched = available;
      if (refill()) continue;
      if (available == 0) return false;
      first = buffer_.data() + begin_;
    }
    line = std::string_view(first, length);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    const size_t taken = length + (found ? 1 : 0);
    begin_ += taken;
    offset_ += taken;
    ++line_;
    return true;
  }
}

std::span<const std::byte> ImportReader::read(size_t count) {
  while (end_ - begin_ < count) {
    if (count > left() || !refill())
      fail(fmt::format("{}: byte {}", name_, offset_), "the file ends too soon");
  }
  const std::span<const char> taken(buffer_.data() + begin_, count);
  begin_ += count;
  offset_ += count;
  return std::as_bytes(taken);
}

std::string ImportReader::line_place() const { return fmt::format("{}: line {}", name_, line_); }

std::string_view take_word(std::string_view& text) {
  size_t first = 0;
  while (first < text.size() && is_blank(text[first])) ++first;
  size_t last = first;
  while (last < text.size() && !is_blank(text[last])) ++last;
  const std::string_view word = text.substr(first, last - first);
  text.remove_prefix(last);
  return word;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> to_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || end != word.data() + word.size()) return std::nullopt;
  // from_chars does not say whether the number was too large or too small; strtod does. The locale of the
  // program may have a decimal comma.
  if (error == std::errc::result_out_of_range) {
    static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
    return ::strtod_l(std::string(word).c_str(), nullptr, plain);
  }
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

std::optional<int64_t> to_integer(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || end != word.data() + word.size() || error != std::errc()) return std::nullopt;
  return value;
}

}  // namespace triptych
