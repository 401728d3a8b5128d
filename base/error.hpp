// Errors that a user, a file or a peer can cause. Each names its place; the program's outermost layer prints
// it, once.
#pragma once

#include <fmt/core.h>
#include <stdexcept>
#include <string>

namespace triptych {

/// What went wrong and where: "place: what". The place is a file, section, chunk, byte, peer or frame.
class Error : public std::runtime_error {
 public:
  Error(const std::string& place, const std::string& what) : std::runtime_error(place + ": " + what) {}
};

/// Throws Error(place, formatted message).
template <typename... Arguments>
[[noreturn]] void fail(const std::string& place, fmt::format_string<Arguments...> format,
                       Arguments&&... arguments) {
  throw Error(place, fmt::format(format, std::forward<Arguments>(arguments)...));
}

}  // namespace triptych
