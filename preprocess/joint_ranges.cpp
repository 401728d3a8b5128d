#include "preprocess/joint_ranges.hpp"

#include "simplify/median_split.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

namespace triptych {

namespace {

/// A range with no more leaves is split by file: fewer give tighter boxes, more keep more nodes as they are.
constexpr uint64_t few_leaves = 32;

/// The number of the fewest binary digits in (from, to].
double simplest_between(double from, double to) {
  int exponent = 0;
  std::frexp(std::max(std::abs(from), std::abs(to)), &exponent);
  for (double step = std::ldexp(1.0, exponent + 1);; step /= 2) {
    const double at = std::floor(to / step) * step;
    if (at > from) return at;
  }
}

}  // namespace

JointRanges::JointRanges(std::span<const ObjectExtent> objects, std::span<const uint64_t> leaves,
                         std::span<const uint32_t> files)
    : leaves_(leaves), files_(files) {
  if (files.empty()) return;
  for (const ObjectExtent& object : objects) centers_.push_back(center(object.box));
}

bool JointRanges::is_joint(Range range) const {
  return !files_.empty() && std::any_of(range.begin(), range.end(), [&](uint32_t object) {
    return files_[object] != files_[range.front()];
  });
}

std::vector<JointRanges::Range> JointRanges::split(Range range) const {
  const auto cut = leaves_of(range) > few_leaves ? halves(range) : std::nullopt;
  if (!cut) return by_file(range);
  std::vector<Range> quarters;
  for (const Range half : *cut) {
    const auto again = is_joint(half) && leaves_of(half) > few_leaves ? halves(half) : std::nullopt;
    if (again) {
      quarters.insert(quarters.end(), again->begin(), again->end());
    } else {
      quarters.push_back(half);
    }
  }
  return quarters;
}

uint64_t JointRanges::leaves_of(Range range) const {
  uint64_t leaves = 0;
  for (const uint32_t object : range) leaves += leaves_of(object);
  return leaves;
}

std::optional<std::vector<JointRanges::Range>> JointRanges::halves(Range range) const {
  Box box;
  for (const uint32_t object : range) box.extend(centers_[object]);
  const glm::dvec3 size = box.hi - box.lo;
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return size[a] > size[b]; });
  const uint64_t all = leaves_of(range);
  for (const int axis : axes) {
    std::sort(range.begin(), range.end(), AlongAxis{centers_, axis});
    // The first half has at least so many objects that they have a quarter of the leaves, and at most three.
    size_t fewest = 0, most = 0;
    uint64_t below = 0;
    for (size_t i = 0; i < range.size(); ++i) {
      if (4 * below < all) fewest = i + 1;
      below += leaves_of(range[i]);
      if (4 * below <= 3 * all) most = i + 1;
    }
    if (fewest > most || most >= range.size()) continue;
    const double from = centers_[range[fewest - 1]][axis], to = centers_[range[most]][axis];
    if (!(from < to)) continue;
    const double cut = simplest_between(from, to);
    const auto above = std::partition_point(range.begin(), range.end(),
                                            [&](uint32_t object) { return centers_[object][axis] < cut; });
    const auto first = static_cast<size_t>(above - range.begin());
    return std::vector<Range>{range.first(first), range.subspan(first)};
  }
  return std::nullopt;
}

std::vector<JointRanges::Range> JointRanges::by_file(Range range) const {
  std::sort(range.begin(), range.end(),
            [&](uint32_t a, uint32_t b) { return files_[a] != files_[b] ? files_[a] < files_[b] : a < b; });
  std::vector<size_t> begins;  // of each file
  for (size_t i = 0; i < range.size(); ++i) {
    if (i == 0 || files_[range[i]] != files_[range[i - 1]]) begins.push_back(i);
  }
  begins.push_back(range.size());
  const size_t files = begins.size() - 1, count = std::min<size_t>(files, 4);
  std::vector<Range> ranges;
  for (size_t i = 0; i < count; ++i) {
    const size_t first = begins[i * files / count], end = begins[(i + 1) * files / count];
    ranges.push_back(range.subspan(first, end - first));
  }
  return ranges;
}

}  // namespace triptych
