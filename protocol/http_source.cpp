#include "protocol/http_source.hpp"

#include "base/error.hpp"
#include "base/notice.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstring>
#include <curl/curl.h>
#include <fmt/core.h>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

namespace triptych {

namespace {

using Transfer = std::unique_ptr<CURL, decltype(&curl_easy_cleanup)>;

/// What a server says of a file, and of the range that it sends.
struct Answer {
  long status = 0;
  uint64_t first = 0, size = 0;  ///< of Content-Range: where the range begins, and how large the file is
  std::string etag, modified;
};

bool begins_with(std::string_view text, std::string_view lower) {
  return text.size() >= lower.size() &&
         std::equal(lower.begin(), lower.end(), text.begin(), [](char wanted, char is) {
           return wanted == (is >= 'A' && is <= 'Z' ? is - 'A' + 'a' : is);
         });
}

/// "bytes 0-31/1234"; zeros where it is something else.
void read_content_range(std::string_view value, Answer& answer) {
  const size_t digits = value.find_first_of("0123456789"), slash = value.find('/');
  if (digits == std::string_view::npos || slash == std::string_view::npos) return;
  std::from_chars(value.data() + digits, value.data() + slash, answer.first);
  std::from_chars(value.data() + slash + 1, value.data() + value.size(), answer.size);
}

size_t take_header(const char* text, size_t one, size_t count, void* user) {
  Answer& answer = *static_cast<Answer*>(user);
  std::string_view line(text, one * count);
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n')) line.remove_suffix(1);
  if (begins_with(line, "http/")) answer = {};  // of a redirection, or 100, before it
  const size_t colon = line.find(':');
  if (colon == std::string_view::npos) return one * count;
  std::string_view value = line.substr(colon + 1);
  value.remove_prefix(std::min(value.size(), value.find_first_not_of(" \t")));
  if (begins_with(line, "content-range:")) read_content_range(value, answer);
  if (begins_with(line, "etag:")) answer.etag = value;
  if (begins_with(line, "last-modified:")) answer.modified = value;
  return one * count;
}

/// Where the bytes of a range go.
struct Body {
  CURL* handle;
  Answer& answer;
  std::span<std::byte> into;
  uint64_t got = 0;
};

size_t take_body(const char* bytes, size_t one, size_t count, void* user) {
  Body& body = *static_cast<Body*>(user);
  curl_easy_getinfo(body.handle, CURLINFO_RESPONSE_CODE, &body.answer.status);
  constexpr long partial_content = 206;
  // Anything else is not the range: it ends here, however much of it there is.
  if (body.answer.status != partial_content || one * count > body.into.size() - body.got) return 0;
  std::memcpy(body.into.data() + body.got, bytes, one * count);
  body.got += one * count;
  return one * count;
}

bool is_busy(long status) { return status == 429 || status == 500 || (status >= 502 && status <= 504); }

class HttpSource final : public ByteSource {
 public:
  HttpSource(const std::string& address, const HttpPatience& patience) : name_(address), patience_(patience) {
    static const CURLcode ready = curl_global_init(CURL_GLOBAL_DEFAULT);
    if (ready != CURLE_OK) fail(name_, "{}", curl_easy_strerror(ready));
    std::array<std::byte, 1> first{};
    const Answer answer = request(0, first, name_);
    if (answer.size == 0) fail(name_, "the server does not say how large the file is");
    size_ = answer.size;
    // A weak ETag says nothing about bytes.
    validator_ = answer.etag.starts_with('"') ? answer.etag : answer.modified;
  }

  const std::string& name() const override { return name_; }
  uint64_t size() const override { return size_; }
  void read(uint64_t offset, std::span<std::byte> into, const std::string& place) const override {
    if (!into.empty()) request(offset, into, place);
  }
  Habits habits() const override {
    return {.threads = 8, .most_at_once = 1 << 20, .unasked = 16 << 10, .far = true};
  }

 private:
  Answer request(uint64_t offset, std::span<std::byte> into, const std::string& place) const {
    Transfer handle = take_transfer();
    uint64_t got = 0;
    double pause_s = patience_.first_pause_s;
    for (uint32_t tries = 1;; ++tries) {
      Answer answer;
      const uint64_t before = got;
      const std::string trouble = try_once(handle.get(), offset, into, got, answer, place);
      if (trouble.empty()) {
        give_back(std::move(handle));
        return answer;
      }
      if (got > before) {
        tries = 0;
        pause_s = patience_.first_pause_s;
      }
      if (tries >= patience_.tries) fail(place, "{}, {} times in a row", trouble, tries);
      if (!said_.exchange(true)) notice("{}: {}; asks for it again", name_, trouble);
      std::this_thread::sleep_for(std::chrono::duration<double>(pause_s));
      pause_s *= 2;
      handle = Transfer(curl_easy_init(), curl_easy_cleanup);  // with a connection of its own
    }
  }

  /// What is missing from the range; empty where all of it came. Error for what another try does not change.
  std::string try_once(CURL* handle, uint64_t offset, std::span<std::byte> into, uint64_t& got,
                       Answer& answer, const std::string& place) const {
    Body body{handle, answer, into.subspan(got)};
    const uint64_t from = offset + got, to = offset + into.size() - 1;
    const std::string range = fmt::format("{}-{}", from, to);
    curl_slist* headers = nullptr;
    if (!validator_.empty()) headers = curl_slist_append(nullptr, ("If-Range: " + validator_).c_str());
    prepare(handle, range, headers, body);
    const CURLcode code = curl_easy_perform(handle);
    curl_slist_free_all(headers);
    got += body.got;
    curl_easy_getinfo(handle, CURLINFO_RESPONSE_CODE, &answer.status);
    if (answer.status == 404 || answer.status == 410)
      fail(place, "there is no such file on the server (404)");
    if (answer.status == 401 || answer.status == 403)
      fail(place, "the server does not give it to us ({})", answer.status);
    if (is_busy(answer.status)) return fmt::format("the server answers {}", answer.status);
    if (answer.status == 200 && size_ > 0) fail_changed(place);
    if (answer.status == 200)
      fail(place, "the server has no ranges (it answers with the whole file), which a pack is read by");
    if (answer.status == 416 && size_ > 0) fail_changed(place);
    if (answer.status != 0 && answer.status != 206) fail(place, "the server answers {}", answer.status);
    if (answer.status == 206 && answer.first != from)
      fail(place, "the server sends another range than it was asked for");
    if (answer.status == 206 && size_ > 0 && answer.size != size_) fail_changed(place);
    if (got == into.size()) return {};
    if (code == CURLE_COULDNT_RESOLVE_HOST || code == CURLE_PEER_FAILED_VERIFICATION ||
        code == CURLE_URL_MALFORMAT)
      fail(place, "{}", curl_easy_strerror(code));
    return code == CURLE_OK ? "the server's answer is too short" : curl_easy_strerror(code);
  }

  void prepare(CURL* handle, const std::string& range, curl_slist* headers, Body& body) const {
    const auto set = [&](CURLoption option, auto value) { curl_easy_setopt(handle, option, value); };
    constexpr long redirections = 5;
    set(CURLOPT_URL, name_.c_str());
    set(CURLOPT_PROTOCOLS_STR, "http,https");
    set(CURLOPT_REDIR_PROTOCOLS_STR, "http,https");
    set(CURLOPT_FOLLOWLOCATION, 1L);
    set(CURLOPT_MAXREDIRS, redirections);
    set(CURLOPT_USERAGENT, "triptych");
    set(CURLOPT_NOSIGNAL, 1L);
    set(CURLOPT_RANGE, range.c_str());
    set(CURLOPT_HTTPHEADER, headers);
    set(CURLOPT_HEADERFUNCTION, take_header);
    set(CURLOPT_HEADERDATA, &body.answer);
    set(CURLOPT_WRITEFUNCTION, take_body);
    set(CURLOPT_WRITEDATA, &body);
    set(CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(1000 * patience_.connect_s));
    set(CURLOPT_LOW_SPEED_LIMIT, 1L);
    set(CURLOPT_LOW_SPEED_TIME, std::max(1L, static_cast<long>(patience_.silence_s)));
  }

  [[noreturn]] static void fail_changed(const std::string& place) {
    fail(place,
         "the file on the server is not the one that was opened any more: start again to see this one");
  }

  Transfer take_transfer() const {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return {curl_easy_init(), curl_easy_cleanup};
    Transfer handle = std::move(idle_.back());
    idle_.pop_back();
    return handle;
  }
  void give_back(Transfer handle) const {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(handle));
  }

  std::string name_;
  HttpPatience patience_;
  uint64_t size_ = 0;
  std::string validator_;  ///< for If-Range; empty where the server says none
  mutable std::mutex mutex_;
  mutable std::vector<Transfer> idle_;  ///< with connections that are kept
  mutable std::atomic<bool> said_{false};
};

}  // namespace

bool is_web_address(const std::string& name) {
  return begins_with(name, "http://") || begins_with(name, "https://");
}

std::unique_ptr<ByteSource> open_http(const std::string& address, const HttpPatience& patience) {
  return std::make_unique<HttpSource>(address, patience);
}

}  // namespace triptych
