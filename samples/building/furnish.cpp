#include "samples/building/furnish.hpp"

#include "base/threads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace triptych {
namespace {

/// How many placements each room keeps: in proportion, the rest by largest remainder.
std::vector<size_t> quotas(const std::vector<std::vector<FurniturePlacement>>& rooms, size_t wanted) {
  size_t total = 0;
  for (const auto& room : rooms) total += room.size();
  std::vector<size_t> kept(rooms.size()), order(rooms.size());
  std::vector<size_t> remainder(rooms.size());
  size_t left = std::min(wanted, total);
  const size_t share = left;
  for (size_t i = 0; i < rooms.size(); ++i) {
    kept[i] = total == 0 ? 0 : rooms[i].size() * share / total;
    remainder[i] = total == 0 ? 0 : rooms[i].size() * share % total;
    left -= kept[i];
  }
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return remainder[a] > remainder[b]; });
  for (size_t i = 0; i < order.size() && left > 0; ++i) {
    if (kept[order[i]] >= rooms[order[i]].size()) continue;
    ++kept[order[i]];
    --left;
  }
  return kept;
}

Furnishing furnish_with(const Supply& supply, const FloorPlan& plan, size_t wanted, const Random& random) {
  std::vector<std::vector<FurniturePlacement>> rooms(plan.rooms.size());
  parallel_for(rooms.size(), [&](size_t room) {
    rooms[room] = furnish_room(supply, plan, static_cast<int>(room), random.fork(room));
  });
  const auto kept = quotas(rooms, wanted);
  Furnishing furnishing;
  for (size_t room = 0; room < rooms.size(); ++room) {
    for (size_t i = 0; i < kept[room]; ++i) {
      furnishing.triangles += supply.triangles[rooms[room][i].piece];
      furnishing.placements.push_back(rooms[room][i]);
    }
  }
  return furnishing;
}

}  // namespace

Furnishing furnish_building(const Furniture& furniture, const RolePools& pools,
                            const std::vector<uint64_t>& triangles, const FloorPlan& plan, size_t wanted,
                            double mean_triangles, const Random& random) {
  // More thrift gives fewer triangles: the thrift that gives the wanted mean is between these two.
  double generous = -2, thrifty = 8, nearest = std::numeric_limits<double>::infinity();
  Furnishing best;
  for (int step = 0; step < 10 && nearest > mean_triangles * 0.02; ++step) {
    const double thrift = (generous + thrifty) / 2;
    Furnishing furnishing = furnish_with({furniture, pools, triangles, thrift}, plan, wanted, random);
    const auto count = static_cast<double>(std::max<size_t>(1, furnishing.placements.size()));
    const double mean = static_cast<double>(furnishing.triangles) / count;
    (mean > mean_triangles ? generous : thrifty) = thrift;
    if (std::abs(mean - mean_triangles) >= nearest) continue;
    nearest = std::abs(mean - mean_triangles);
    best = std::move(furnishing);
  }
  return best;
}

}  // namespace triptych
