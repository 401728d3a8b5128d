// What frames take: how long one waits for a visible set, and what is said of a frame that takes long.
#include "nodes/frame_patience.hpp"
#include "nodes/frame_watch.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace triptych {
namespace {

using namespace std::chrono_literals;

TEST(FramePatience, is_what_was_asked_for_where_frames_are_quick) {
  FramePatience patience(500ms);
  EXPECT_EQ(patience.limit(), 500ms);
  for (int i = 0; i < 20; ++i) patience.worked(i);
  EXPECT_EQ(patience.limit(), 500ms);
  EXPECT_EQ(patience.reason(), "--timeout 500");
}

TEST(FramePatience, is_four_times_the_slowest_of_recent_frames) {
  FramePatience patience(500ms);
  patience.worked(900);
  patience.worked(100);
  EXPECT_EQ(patience.limit(), 3600ms);
  EXPECT_EQ(patience.reason(), "--timeout 500, stretched for frames of 900 ms");
  for (int i = 0; i < 7; ++i) patience.worked(100);
  EXPECT_EQ(patience.limit(), 500ms) << "one slow frame is forgotten";
}

TEST(FrameWatch, says_now_and_then_that_a_frame_still_takes) {
  testing::internal::CaptureStderr();
  {
    FrameWatch watch("here", 40ms);
    watch.begin(7);
    std::this_thread::sleep_for(400ms);
    watch.end();
    for (uint32_t quick = 8; quick < 12; ++quick) {
      watch.begin(quick);
      watch.end();
    }
  }
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_GE(std::count(said.begin(), said.end(), '\n'), 2) << said;
  EXPECT_NE(said.find("here: frame 7 has taken 0."), std::string::npos) << said;
  EXPECT_EQ(said.find("frame 8"), std::string::npos) << said;
}

}  // namespace
}  // namespace triptych
