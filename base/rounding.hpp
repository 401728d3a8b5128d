// Arithmetic that rounds to nearest, whatever rounding mode the program has set.
#pragma once

#include <cfenv>

namespace triptych {

/// Sets the rounding mode to nearest while it lives, and restores the previous one. Computations under it
/// belong in a function of another file or one that is not inlined: otherwise compilers may move arithmetic
/// across it.
class NearestRounding {
 public:
  NearestRounding() : before_(std::fegetround()) {
    if (before_ != FE_TONEAREST) std::fesetround(FE_TONEAREST);
  }
  ~NearestRounding() {
    if (before_ != FE_TONEAREST) std::fesetround(before_);
  }
  NearestRounding(const NearestRounding&) = delete;
  NearestRounding& operator=(const NearestRounding&) = delete;

 private:
  int before_;
};

template <typename Body>
[[gnu::noinline]] auto call_apart(const Body& body) {
  return body();
}

/// The result of the body, computed under NearestRounding.
template <typename Body>
auto round_to_nearest(const Body& body) {
  const NearestRounding rounding;
  return call_apart(body);
}

}  // namespace triptych
