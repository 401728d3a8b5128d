#include "scene/lattice.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>

namespace triptych {
namespace {

TEST(Lattice, its_points_are_exact_doubles_wherever_the_model_stands) {
  for (const double place : {0.0, 1.0, -12345.678, 5e6, 1e12}) {
    for (const double size : {1e-3, 1.0, 300.0, 1e6}) {
      const Box box{glm::dvec3(place), glm::dvec3(place) + glm::dvec3(size, size / 3, 0)};
      const Lattice lattice = make_lattice(box, 26);
      int exponent = 0;
      EXPECT_EQ(std::frexp(lattice.step, &exponent), 0.5) << "the step is a power of two";
      for (const int point : {-Lattice::limit, -12345, 0, 1, 7654321, Lattice::limit}) {
        const glm::dvec3 position = lattice.position(glm::ivec3(point));
        EXPECT_EQ(lattice.nearest(position), glm::ivec3(point)) << place << " " << size;
      }
    }
  }
}

TEST(Lattice, rounding_never_moves_a_point_further_than_it_says) {
  std::mt19937 random(1);
  for (const double place : {0.0, -700.25, 1e7}) {
    const Box box{glm::dvec3(place), glm::dvec3(place) + glm::dvec3(40, 30, 20)};
    const Lattice lattice = make_lattice(box, 12);
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < 1000; ++i) {
      const glm::dvec3 position =
          box.lo + glm::dvec3(share(random), share(random), share(random)) * (box.hi - box.lo);
      EXPECT_LE(glm::distance(position, lattice.position(lattice.nearest(position))),
                lattice.rounding() * (1 + 1e-12));
    }
  }
}

TEST(Lattice, has_about_the_cells_that_were_asked_for) {
  const Lattice lattice = make_lattice({{0, 0, 0}, {100, 10, 1}}, 20);
  const double cells = 100 / lattice.step;
  EXPECT_LE(cells, 1 << 20);
  EXPECT_GT(cells, 1 << 19);
}

TEST(Lattice, stays_where_it_is_when_the_box_grows_a_little) {
  const Box box{{3, 4, 5}, {103, 44, 25}};
  int moved = 0;
  for (int i = 1; i <= 20; ++i) {
    Box larger = box;
    larger.extend(box.hi + glm::dvec3(0.1 * i));  // by up to 2 %
    moved += make_lattice(larger, 26) != make_lattice(box, 26);
  }
  EXPECT_EQ(moved, 0);
  Box other = box;
  other.extend(glm::dvec3(-300));
  EXPECT_NE(make_lattice(other, 26), make_lattice(box, 26)) << "in the end it follows";
}

TEST(Lattice, a_point_and_an_empty_box_have_lattices_too) {
  EXPECT_GT(make_lattice({glm::dvec3(5), glm::dvec3(5)}, 26).step, 0);
  EXPECT_GT(make_lattice({glm::dvec3(0), glm::dvec3(0)}, 26).step, 0);
  EXPECT_EQ(make_lattice({}, 26), Lattice());
}

TEST(Lattice, the_enclosing_box_encloses) {
  const Box box{{-1.23456, 7, 0.001}, {4.4, 7, 0.002}};
  const Lattice lattice = make_lattice({{-10, -10, -10}, {10, 10, 10}}, 8);
  const Box around = lattice.box(lattice.enclosing(box));
  EXPECT_TRUE(around.contains(box));
  EXPECT_LE(around.hi.x - around.lo.x, box.hi.x - box.lo.x + 2 * lattice.step);
}

}  // namespace
}  // namespace triptych
