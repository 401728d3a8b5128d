#include "launch/reader_limits.hpp"

#include "base/error.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <new>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace triptych {

namespace {

void limit(int resource, uint64_t bytes, std::string_view program) {
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
#if !defined(__SANITIZE_ADDRESS__)  // which reserves terabytes
  const rlimit most{bytes, bytes};
  if (::setrlimit(static_cast<__rlimit_resource>(resource), &most) != 0)
    fail(std::string(program), "cannot limit its memory: {}", std::strerror(errno));
#else
  (void)resource, (void)bytes, (void)program;
#endif
}

}  // namespace

void end_out_of_memory() {
  constexpr std::string_view complaint = "triptych: needs more memory to read than it is given\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, complaint.data(), complaint.size());
  ::_exit(1);
}

void limit_address_space(uint64_t bytes, std::string_view program) {
  limit(RLIMIT_AS, bytes, program);
  std::set_new_handler(end_out_of_memory);
}

void limit_data(uint64_t bytes, std::string_view program) { limit(RLIMIT_DATA, bytes, program); }

std::optional<std::map<std::string, std::string>> reader_flags(int count, const char* const* arguments,
                                                               const std::set<std::string>& known) {
  std::map<std::string, std::string> flags;
  if (count % 2 != 0) return std::nullopt;
  for (int i = 1; i + 2 < count; i += 2) {
    if (known.count(arguments[i]) == 0 || !flags.emplace(arguments[i], arguments[i + 1]).second)
      return std::nullopt;
  }
  if (flags.count("--memory") == 0) return std::nullopt;
  return flags;
}

uint64_t memory_argument(std::string_view text) {
  uint64_t bytes = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), bytes).ec != std::errc())
    fail("--memory", "\"{}\" is not a number of bytes", text);
  return bytes;
}

}  // namespace triptych
