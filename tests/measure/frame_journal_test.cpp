// Frame records survive the process that wrote them.
#include "measure/frame_journal.hpp"

#include "base/error.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace triptych {
namespace {

class Journal : public testing::Test {
 protected:
  ~Journal() override { std::filesystem::remove(file); }
  void write(uint32_t number) const {
    FrameRecord record{.number = number};
    record.frame_ms = 1.5 * number;
    record.fallback = number % 2 == 1;
    record.visible = {1, number + 2};
    FrameJournal(file).add(record);
  }
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("triptych_journal_" + std::to_string(::getpid()));
};

TEST_F(Journal, gives_back_what_several_writers_added) {
  EXPECT_EQ(mend_frame_journal(file), 0u);
  EXPECT_TRUE(read_frame_journal(file).empty());
  for (uint32_t number = 0; number < 3; ++number) write(number);
  const auto records = read_frame_journal(file);
  ASSERT_EQ(records.size(), 3u);
  EXPECT_EQ(records[2].number, 2u);
  EXPECT_EQ(records[2].frame_ms, 3);
  EXPECT_TRUE(records[1].fallback);
  EXPECT_EQ(records[2].visible, (VisibleSet{1, 4}));
}

TEST_F(Journal, loses_nothing_but_a_record_that_was_half_written) {
  write(0);
  write(1);
  std::ofstream(file, std::ios::app) << R"({"number": 2, "fra)";
  EXPECT_EQ(mend_frame_journal(file), 2u);
  write(2);
  const auto records = read_frame_journal(file);
  ASSERT_EQ(records.size(), 3u);
  EXPECT_EQ(records.back().number, 2u);
}

TEST_F(Journal, names_the_line_that_is_no_record) {
  write(0);
  std::ofstream(file, std::ios::app) << "nonsense\n";
  try {
    read_frame_journal(file);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace triptych
