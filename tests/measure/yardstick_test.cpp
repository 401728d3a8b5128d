#include "measure/yardstick.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

/// A flat grid of cells × cells squares, far from the origin; every triangle with corners of its own.
Mesh grid_soup(uint32_t cells) {
  Mesh mesh;
  const auto corner = [&](uint32_t x, uint32_t y) {
    mesh.positions.emplace_back(1e6 + x, 1e6 + y, 0);
    return static_cast<uint32_t>(mesh.positions.size() - 1);
  };
  for (uint32_t y = 0; y < cells; ++y) {
    for (uint32_t x = 0; x < cells; ++x) {
      mesh.triangles.push_back({{corner(x, y), corner(x + 1, y), corner(x, y + 1)}, 0});
      mesh.triangles.push_back({{corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)}, 0});
    }
  }
  return mesh;
}

Model model_of(std::vector<Mesh> meshes) {
  Model model;
  model.materials.emplace_back();
  model.meshes = std::move(meshes);
  return model;
}

}  // namespace

TEST(Yardstick, halves_soups_since_it_welds_them_first) {
  const Yardstick yardstick = measure_yardstick(model_of({grid_soup(40), grid_soup(20)}));
  EXPECT_EQ(yardstick.triangles, 3200u + 800u);
  EXPECT_LE(yardstick.left, 2000u + 20u);
  EXPECT_GT(yardstick.left, 1000u);
  EXPECT_GT(yardstick.triangles_per_second(), 0);
}

TEST(Yardstick, a_mesh_in_batches_is_counted_whole) {
  const Yardstick yardstick = measure_yardstick(model_of({grid_soup(40)}), 500);
  EXPECT_EQ(yardstick.triangles, 3200u);
  EXPECT_LT(yardstick.left, 2400u);
}

TEST(Yardstick, of_nothing_has_no_rate) {
  EXPECT_EQ(measure_yardstick(model_of({})).triangles_per_second(), 0);
}

}  // namespace triptych
