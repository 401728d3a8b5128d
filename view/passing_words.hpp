// What a title says for a while.
#pragma once

#include "base/clock.hpp"

#include <string>
#include <utility>

namespace triptych {

/// Long enough to be read, though pictures follow.
class PassingWords {
 public:
  PassingWords& operator=(std::string words) {
    words_ = std::move(words);
    since_.restart();
    return *this;
  }
  /// Empty when their time is over.
  std::string now() const { return since_.seconds() < shown_s ? words_ : std::string(); }

 private:
  static constexpr double shown_s = 3;
  std::string words_;
  Stopwatch since_;
};

}  // namespace triptych
