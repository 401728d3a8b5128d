#include "scene/section.hpp"

#include "base/error.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace triptych {
namespace {

TEST(Section, normals_are_brought_to_length_1_and_stay_so) {
  Section section;
  section.add_plane({{0, 3, 4}, 10}, "test");
  EXPECT_EQ(section.planes()[0], (SectionPlane{{0, 0.6, 0.8}, 2}));
  Section again;
  again.add_plane(section.planes()[0], "test");
  EXPECT_EQ(again, section);
}

TEST(Section, a_box_has_six_sides_that_keep_what_it_holds) {
  Section section;
  EXPECT_TRUE(section.keeps_all());
  section.set_box({{1, 2, 3}, {4, 5, 6}}, "test");
  const SectionSides sides(section);
  ASSERT_EQ(sides.all().size(), 6);
  for (const SectionPlane& side : sides.all()) {
    EXPECT_GT(side.distance({2, 3, 4}), 0);
    EXPECT_GE(side.distance({1, 2, 3}), 0);
  }
  int outside = 0;
  for (const SectionPlane& side : sides.all()) outside += side.distance({0, 6, 4}) < 0;
  EXPECT_EQ(outside, 2);
}

TEST(Section, a_plane_that_is_taken_away_leaves_the_others_in_their_order) {
  Section section, two;
  for (int i = 0; i < 3; ++i) section.add_plane({{1, 0, 0}, static_cast<double>(i)}, "test");
  section.remove_plane(1);
  two.add_plane({{1, 0, 0}, 0}, "test");
  two.add_plane({{1, 0, 0}, 2}, "test");
  EXPECT_EQ(section, two);
}

TEST(Section, what_cuts_nothing_is_an_error) {
  Section section;
  EXPECT_THROW(section.add_plane({{0, 0, 0}, 1}, "test"), Error);
  EXPECT_THROW(section.add_plane({{1, 0, 0}, std::numeric_limits<double>::infinity()}, "test"), Error);
  EXPECT_THROW(section.set_box({{1, 0, 0}, {0, 1, 1}}, "test"), Error);
  for (uint32_t i = 0; i < Section::max_planes; ++i) section.add_plane({{1, 0, 0}, 0}, "test");
  EXPECT_THROW(section.add_plane({{1, 0, 0}, 0}, "test"), Error);
}

}  // namespace
}  // namespace triptych
