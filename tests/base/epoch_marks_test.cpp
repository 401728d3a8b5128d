// Marks that are cleared at once.
#include "base/epoch_marks.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

TEST(EpochMarks, are_gone_after_each_clear_however_often_that_was) {
  EpochMarks marks(3);
  marks.mark(0);  // in the first epoch, whose number comes again
  EXPECT_TRUE(marks.marked(0));
  for (int i = 0; i < 200'000; ++i) {
    marks.clear();
    ASSERT_FALSE(marks.marked(0) || marks.marked(1) || marks.marked(2)) << i;
    if (i % 1000 == 0) {
      EXPECT_TRUE(marks.mark_first(1));
      EXPECT_FALSE(marks.mark_first(1));
    }
  }
}

}  // namespace
}  // namespace triptych
