// Random choices whose results are the same everywhere: std:: distributions leave theirs to the library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace triptych {

/// A stream of random numbers; fork() gives independent streams, so that the choices in one room never change
/// those in another.
class Random {
 public:
  explicit Random(uint64_t seed) : seed_(seed), engine_(mixed(seed)) {}

  Random fork(uint64_t key) const { return Random(mixed(seed_ ^ mixed(key + 1))); }

  /// 0 <= result < 1.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  bool chance(double probability) { return uniform() < probability; }
  /// 0 <= result < count; count must not be 0.
  size_t below(size_t count) { return static_cast<size_t>(uniform() * static_cast<double>(count)); }

  template <typename Value>
  const Value& pick(const std::vector<Value>& values) {
    return values[below(values.size())];
  }

  template <typename Value>
  void shuffle(std::vector<Value>& values) {
    for (size_t left = values.size(); left > 1; --left) std::swap(values[left - 1], values[below(left)]);
  }

 private:
  // SplitMix64's finalizer (Steele, Lea, Flood 2014): neighbouring seeds become unrelated ones.
  static uint64_t mixed(uint64_t value) {
    value += 0x9e3779b97f4a7c15u;
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
    return value ^ (value >> 31);
  }

  uint64_t seed_;
  std::mt19937_64 engine_;
};

}  // namespace triptych
