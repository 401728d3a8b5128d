#include "model/import/import_reader.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
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
    : ImportReader(std::make_shared<StreamSource>(file)) {}

ImportReader::ImportReader(std::shared_ptr<const StreamSource> source) : reader_(std::move(source)) {}

bool ImportReader::refill() {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    for (Found* found : {&newline_, &carriage_return_}) {
      found->at -= std::min(found->at, begin_);
      found->searched -= std::min(found->searched, begin_);
    }
    end_ -= begin_;
    begin_ = 0;
  }
  const uint64_t unread = size() - offset_ - end_;
  if (buffer_.size() < end_ + block_bytes) buffer_.resize(std::max(end_ + block_bytes, buffer_.size() * 2));
  const auto count = static_cast<size_t>(std::min<uint64_t>(buffer_.size() - end_, unread));
  reader_.read(offset_ + end_, std::as_writable_bytes(std::span(buffer_)).subspan(end_, count));
  end_ += count;
  return count > 0;
}

void ImportReader::consume(size_t count) {
  begin_ += count;
  offset_ += count;
}

void ImportReader::pass_mark() {
  while (end_ - begin_ < 3 && refill()) {
  }
  const std::string_view beginning(buffer_.data() + begin_, std::min<size_t>(end_ - begin_, 3));
  if (beginning == "\xef\xbb\xbf") consume(3);
  if (beginning.starts_with("\xff\xfe") || beginning.starts_with("\xfe\xff"))
    fail(reader_.source().name(), "is text in UTF-16; save it as UTF-8");
}

/// The place of the next such letter in the buffer; end_ if there is none.
size_t ImportReader::find(Found& found, char letter) {
  if (found.at >= begin_ && found.at < found.searched) return found.at;
  const size_t from = std::max(begin_, found.searched);
  const void* place = from < end_ ? std::memchr(buffer_.data() + from, letter, end_ - from) : nullptr;
  found.at = place ? static_cast<size_t>(static_cast<const char*>(place) - buffer_.data()) : end_;
  found.searched = place ? found.at + 1 : end_;
  return found.at;
}

bool ImportReader::next_line(std::string_view& line) {
  if (offset_ == 0) pass_mark();
  for (bool more = true;;) {
    const size_t newline = find(newline_, '\n'), carriage_return = find(carriage_return_, '\r');
    const size_t last = std::min(newline, carriage_return);
    if (last - begin_ > max_line_bytes)
      fail(fmt::format("{}: line {}", reader_.source().name(), line_ + 1), "is longer than 64 MiB");
    // Whether a \n follows a \r has to be known.
    const bool whole = newline < carriage_return || carriage_return + 1 < end_;
    if ((last == end_ || !whole) && more) {
      more = refill();
      continue;  // which moved what is in the buffer
    }
    if (begin_ == end_) return false;
    line = std::string_view(buffer_.data() + begin_, last - begin_);
    size_t taken = line.size() + (last < end_ ? 1 : 0);
    if (last == carriage_return && last < end_) {
      // Behind a header whose lines end with \r alone, a \n is the first byte of what follows.
      const bool pair = newline == last + 1 && newline < end_ && (newlines_ || !lone_returns_);
      taken += pair ? 1 : 0;
      lone_returns_ = lone_returns_ || !pair;
      newlines_ = newlines_ || pair;
    }
    newlines_ = newlines_ || (last == newline && last < end_);
    consume(taken);
    ++line_;
    return true;
  }
}

std::span<const std::byte> ImportReader::read(size_t count) {
  while (end_ - begin_ < count) {
    if (count > left() || !refill())
      fail(fmt::format("{}: byte {}", reader_.source().name(), offset_), "the file ends too soon");
  }
  const std::span<const char> taken(buffer_.data() + begin_, count);
  consume(count);
  return std::as_bytes(taken);
}

std::string ImportReader::line_place() const {
  return fmt::format("{}: line {}", reader_.source().name(), line_);
}

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

namespace {
/// What Visual C++ before 2015 wrote in place of numbers: "1.#QNAN", "-1.#IND", "1.#INF", with digits behind.
bool is_visual_c_special(std::string_view word) {
  if (word.starts_with('-')) word.remove_prefix(1);
  return word.starts_with("1.#");
}
}  // namespace

std::optional<double> to_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (!word.empty() && end != word.data() + word.size() && is_visual_c_special(word))
    return std::numeric_limits<double>::quiet_NaN();
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
