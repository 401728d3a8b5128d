#include "preprocess/covered/look_over.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace triptych {

namespace {

/// Places all over a triangle, inside and near its corners, so that none of it is further than about `apart`
/// from one: in 2 to 8 rows from the corner that its shortest side lies opposite to that side, each as dense
/// as it is wide. False as soon as take(place) is.
template <typename Take>
bool each_sample(const std::array<glm::dvec3, 3>& corners, double apart, const Take& take) {
  constexpr double inset = 0.01;
  size_t top = 0;
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double side = glm::distance(corners[(k + 1) % 3], corners[(k + 2) % 3]);
    longest = std::max(longest, side);
    if (side < shortest) {
      shortest = side;
      top = k;
    }
  }
  const auto steps = [&](double length) { return static_cast<int>(std::ceil(length / apart)); };
  const int rows = std::clamp(steps(longest), 2, 8);
  for (int row = 0; row < rows; ++row) {
    const double down = static_cast<double>(row) / (rows - 1);
    const int places = std::min(row + 1, steps(down * shortest) + 1);
    for (int i = 0; i < places; ++i) {
      const double across = places > 1 ? down * i / (places - 1) : 0;
      const auto share = [](double of) { return inset + (1 - 3 * inset) * of; };
      if (!take(corners[top] * share(1 - down) + corners[(top + 1) % 3] * share(down - across) +
                corners[(top + 2) % 3] * share(across)))
        return false;
    }
  }
  return true;
}

/// How large the surface is that a region is taken for. Of which a border cut off a corner that is not known:
/// it may lie deeper than the corner alone might, where it is hidden from the sides, too.
struct RegionSize {
  double own = 0, whole = 0;
  bool is_corner() const { return own < whole; }
};

RegionSize size_of(const PlacedRegions& own, uint32_t index) {
  const SmoothRegion& region = own.regions->regions[index];
  const double size = diagonal(own.out(region.box));
  return {size, std::max(size, region.is_cut ? own.regions->diagonal / own.shrink / 4 : 0)};
}

}  // namespace

std::vector<uint32_t> reached_from(Surroundings& surroundings, uint32_t region, double tolerance) {
  const PlacedRegions& own = surroundings.own();
  const RegionSize size = size_of(own, region);
  const Box box = own.out(own.regions->regions[region].box);
  // As far as the rays of Surroundings::over() and hidden_from_sides() go.
  const double reach = (size.is_corner() ? 4 : 1) * size.whole;
  return surroundings.reaching(grown(box, reach / 16 + 4 * tolerance), grown(box, reach + 4 * tolerance));
}

std::optional<std::vector<RegionCover>> look_over(Surroundings& surroundings, uint32_t index,
                                                  double tolerance) {
  const PlacedRegions& own = surroundings.own();
  const SmoothRegion& region = own.regions->regions[index];
  const RegionSize size = size_of(own, index);
  if (size.own < 8 * tolerance) return std::nullopt;
  const double apart = size.own / 12;
  std::map<uint32_t, double> nearest;
  for (uint32_t i = region.first; i < region.first + region.count; ++i) {
    const auto corners = own.corners(i);
    glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double length = glm::length(normal);
    if (!(length > 0)) continue;
    normal *= (own.turns_over ? -1 : 1) / length;
    const bool all = each_sample(corners, apart, [&](const glm::dvec3& at) {
      const auto over = surroundings.over(index, at, normal, size.whole);
      if (!over) return false;
      const auto [entry, inserted] = nearest.try_emplace(over->placed, over->clearance);
      if (!inserted) entry->second = std::min(entry->second, over->clearance);
      return !size.is_corner() || surroundings.hidden_from_sides(index, at, normal, size.whole);
    });
    if (!all) return std::nullopt;
  }
  std::vector<RegionCover> covers;
  for (const auto& [placed, clearance] : nearest) covers.push_back({placed, clearance});
  return covers;
}

}  // namespace triptych
