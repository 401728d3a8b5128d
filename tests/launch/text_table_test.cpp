#include "launch/text_table.hpp"

#include <gtest/gtest.h>

namespace triptych {

TEST(TextTable, digits_stand_in_threes) {
  EXPECT_EQ(in_threes(0), "0");
  EXPECT_EQ(in_threes(999), "999");
  EXPECT_EQ(in_threes(1000), "1,000");
  EXPECT_EQ(in_threes(12345678.25, 2), "12,345,678.25");
  EXPECT_EQ(in_threes(-123), "-123");
  EXPECT_EQ(in_threes(-1234), "-1,234");
}

TEST(TextTable, columns_are_as_wide_as_their_widest_cell) {
  EXPECT_EQ(text_table({"name", "n"}, {{"a", "1,000"}, {"longer", "2"}}),
            "name        n\n"
            "a       1,000\n"
            "longer      2\n");
}

}  // namespace triptych
