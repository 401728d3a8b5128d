#include "preprocess/buckets.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>

namespace triptych {
namespace {

std::filesystem::path spool_path() {
  return std::filesystem::path(testing::TempDir()) / ("triptych_buckets_" + std::to_string(::getpid()));
}

/// A bumpy sheet of points on a lattice, two triangles a cell, and one triangle far away from it.
std::vector<LatticeTriangle> sheet(int cells) {
  const auto point = [](int x, int y) { return glm::ivec3{x * 50, y * 50, (x * y) % 17}; };
  std::vector<LatticeTriangle> triangles;
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      triangles.push_back({{point(x, y), point(x + 1, y), point(x + 1, y + 1)}, 1});
      triangles.push_back({{point(x, y), point(x + 1, y + 1), point(x, y + 1)}, 2});
    }
  }
  triangles.push_back({{glm::ivec3{1 << 28, 0, 0}, {1 << 28, 5, 0}, {1 << 28, 0, 5}}, 3});
  return triangles;
}

Buckets::Read reading(const std::vector<LatticeTriangle>& triangles) {
  return [&triangles](uint64_t every, const Buckets::Take& take) {
    std::vector<LatticeTriangle> batch;
    for (size_t i = 0; i < triangles.size(); i += every) {
      batch.push_back(triangles[i]);
      if (batch.size() < 100 && i + every < triangles.size()) continue;
      take(batch);
      batch.clear();
    }
  };
}

TEST(Buckets, hold_every_triangle_once_and_none_too_many) {
  const auto triangles = sheet(60);
  SpoolFile spool(spool_path());
  const Buckets buckets(reading(triangles), triangles.size(), 500, {}, spool);
  EXPECT_GT(buckets.count(), 10u);
  std::map<std::array<int, 9>, int> found;
  const auto key = [](const LatticeTriangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    return std::array{a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z};
  };
  for (size_t i = 0; i < buckets.count(); ++i) {
    const Bucket bucket = buckets.load(i);
    EXPECT_EQ(bucket.triangles.size(), buckets.triangles(i));
    EXPECT_LE(bucket.triangles.size(), 500u);
    for (const LatticeTriangle& triangle : bucket.triangles) ++found[key(triangle)];
  }
  EXPECT_EQ(found.size(), triangles.size());
  for (const auto& [corners, times] : found) EXPECT_EQ(times, 1);
  std::filesystem::remove(spool_path());
}

TEST(Buckets, know_every_point_that_they_share) {
  const auto triangles = sheet(40);
  SpoolFile spool(spool_path());
  const Buckets buckets(reading(triangles), triangles.size(), 300, {}, spool);
  std::map<std::array<int, 3>, std::set<size_t>> users;
  std::vector<Bucket> loaded;
  for (size_t i = 0; i < buckets.count(); ++i) {
    loaded.push_back(buckets.load(i));
    for (const LatticeTriangle& triangle : loaded.back().triangles) {
      for (const glm::ivec3& p : triangle.corners) users[{p.x, p.y, p.z}].insert(i);
    }
  }
  size_t shared = 0, marked = 0;
  std::map<uint32_t, std::array<int, 3>> numbers;  // every bucket knows a point by the same one
  for (const auto& [point, in] : users) {
    if (in.size() < 2) continue;
    ++shared;
    for (const size_t bucket : in) {
      const glm::ivec3 p{point[0], point[1], point[2]};
      const auto number = number_in(loaded[bucket].shared, p);
      ASSERT_TRUE(number.has_value());
      EXPECT_LT(*number, buckets.shared_points());
      EXPECT_EQ(numbers.try_emplace(*number, point).first->second, point);
      ++marked;
    }
  }
  EXPECT_GT(shared, 50u);
  size_t listed = 0;
  for (const Bucket& bucket : loaded) listed += bucket.shared.size();
  EXPECT_LE(listed, 2 * marked);  // few points are held back that nobody shares
  std::filesystem::remove(spool_path());
}

TEST(Buckets, triangles_at_one_place_end_in_one_bucket) {
  const std::vector<LatticeTriangle> triangles(2000, {{glm::ivec3{0, 0, 0}, {9, 0, 0}, {0, 9, 0}}, 0});
  SpoolFile spool(spool_path());
  const Buckets buckets(reading(triangles), triangles.size(), 100, {}, spool);
  ASSERT_EQ(buckets.count(), 1u);
  EXPECT_EQ(buckets.load(0).triangles.size(), 2000u);
  std::filesystem::remove(spool_path());
}

TEST(Buckets, keep_the_colours_and_normals_of_corners_where_there_are_any_and_write_none_otherwise) {
  auto triangles = sheet(20);
  for (size_t i = 0; i < triangles.size(); ++i) {
    triangles[i].corner_colors.fill({static_cast<uint8_t>(i), static_cast<uint8_t>(i >> 8), 9, 255});
    triangles[i].corner_normals.fill({static_cast<uint16_t>(i + 1), 7});
    triangles[i].coordinates.fill({static_cast<int32_t>(i), 7});
  }
  std::vector<uint64_t> sizes;
  for (const CornerStreams& streams :
       {CornerStreams{}, CornerStreams{.colors = true}, CornerStreams{.colors = true, .normals = true},
        CornerStreams{.colors = true, .normals = true, .coordinates = true}}) {
    SpoolFile spool(spool_path());
    const Buckets buckets(reading(triangles), triangles.size(), 100, streams, spool);
    sizes.push_back(spool.size());
    for (size_t i = 0; i < buckets.count(); ++i) {
      for (const LatticeTriangle& triangle : buckets.load(i).triangles) {
        const CornerColors& colors = triangle.corner_colors;
        if (!streams.colors) {
          EXPECT_EQ(colors, CornerColors{});
          continue;
        }
        const size_t index = colors[2][0] + size_t{256} * colors[2][1];
        ASSERT_LT(index, triangles.size());
        LatticeTriangle wanted = triangles[index];
        if (!streams.normals) wanted.corner_normals = {};
        if (!streams.coordinates) wanted.coordinates = {};
        EXPECT_EQ(triangle, wanted);
      }
    }
    std::filesystem::remove(spool_path());
  }
  EXPECT_EQ(sizes, (std::vector<uint64_t>{40 * triangles.size(), 52 * triangles.size(), 64 * triangles.size(),
                                          88 * triangles.size()}));
}

}  // namespace
}  // namespace triptych
