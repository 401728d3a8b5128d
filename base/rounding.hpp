// Arithmetic rounds to nearest here, whatever the program around us has set.
#pragma once

#include <cfenv>

namespace triptych {

/// Sets the rounding mode to nearest while it lives, and puts back what was. What is to be computed under it
/// belongs into a function of another file or one that is not inlined: compilers move arithmetic over it
/// otherwise.
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

/// What the body returns, computed under it.
template <typename Body>
auto round_to_nearest(const Body& body) {
  const NearestRounding rounding;
  return call_apart(body);
}

}  // namespace triptych
