#include "preprocess/spatial_order.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>

namespace triptych {
namespace {

double way_along(const std::vector<Box>& boxes, const std::vector<uint32_t>& order) {
  double way = 0;
  for (size_t i = 1; i < order.size(); ++i)
    way += glm::distance(center(boxes[order[i - 1]]), center(boxes[order[i]]));
  return way;
}

TEST(SpatialOrder, has_each_box_once_and_those_near_each_other_one_after_the_other) {
  std::vector<Box> boxes;
  for (int i = 0; i < 4096; ++i) {
    const glm::dvec3 at(i % 16, i / 16 % 16, i / 256);
    boxes.push_back({at * 3.0 - 7.0, at * 3.0 - 6.0});
  }
  std::shuffle(boxes.begin(), boxes.end(), std::mt19937(5));
  std::vector<uint32_t> order = spatial_order(boxes);
  EXPECT_LT(way_along(boxes, order), 4096 * 3 * 2.0) << "less than two steps from each to the next";
  std::ranges::sort(order);
  std::vector<uint32_t> as_they_come(boxes.size());
  for (uint32_t i = 0; i < as_they_come.size(); ++i) as_they_come[i] = i;
  EXPECT_EQ(order, as_they_come);
  EXPECT_GT(way_along(boxes, as_they_come), 4096 * 3 * 4.0);
}

TEST(SpatialOrder, boxes_in_one_place_stay_in_their_order) {
  EXPECT_TRUE(spatial_order({}).empty());
  const std::vector<Box> boxes(5, Box{{1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(spatial_order(boxes), (std::vector<uint32_t>{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace triptych
