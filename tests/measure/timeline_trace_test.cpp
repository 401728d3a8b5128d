#include "measure/timeline_trace.hpp"

#include "base/timeline.hpp"

#include <gtest/gtest.h>
#include <thread>

namespace triptych {
namespace {

const ProcessTimeline render_node{"render node", {{"draw picture", 7, 1010, 1012.5}}, 0};
const ProcessTimeline switch_node{"switch node 0", {{"hardware cull", 7, 503, 506}}, 2};

std::vector<nlohmann::json> spans_of(const nlohmann::json& trace) {
  std::vector<nlohmann::json> spans;
  for (const auto& event : trace.at("traceEvents")) {
    if (event.at("ph") == "X") spans.push_back(event);
  }
  return spans;
}

TEST(TimelineTrace, puts_all_processes_on_the_first_one_s_clock) {
  // The switch node's clock is 500 ms behind: its 503 is 1003 here.
  const auto trace = chrome_trace({render_node, switch_node}, {{"switch node 0", -500, 0.25}});
  const auto spans = spans_of(trace);
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_EQ(spans[0].at("name"), "draw picture");
  EXPECT_DOUBLE_EQ(spans[0].at("ts").get<double>(), 7000);
  EXPECT_DOUBLE_EQ(spans[0].at("dur").get<double>(), 2500);
  EXPECT_DOUBLE_EQ(spans[1].at("ts").get<double>(), 0);
  EXPECT_EQ(spans[1].at("args").at("frame"), 7);
  EXPECT_NE(spans[0].at("pid"), spans[1].at("pid"));
}

TEST(TimelineTrace, says_how_far_clocks_were_moved_and_how_sure_that_is) {
  const auto trace = chrome_trace({render_node, switch_node}, {{"switch node 0", -500, 0.25}});
  const auto clocks = trace.at("otherData").at("clocks");
  EXPECT_EQ(clocks.at(0).at("clock_ahead_ms"), 0);
  EXPECT_EQ(clocks.at(1).at("process"), "switch node 0");
  EXPECT_EQ(clocks.at(1).at("clock_ahead_ms"), -500);
  EXPECT_EQ(clocks.at(1).at("uncertainty_ms"), 0.25);
  EXPECT_EQ(clocks.at(1).at("spans_lost"), 2);
}

TEST(TimelineTrace, is_whole_without_any_span) {
  EXPECT_TRUE(spans_of(chrome_trace({{"render", {}, 0}}, {})).empty());
}

TEST(Timeline, keeps_nothing_until_it_is_started_and_then_what_ends) {
  // In a thread of its own: a timeline belongs to its thread.
  std::thread([] {
    { const TimelineScope scope("before", 1); }
    EXPECT_TRUE(timeline_spans().empty());
    start_timeline();
    {
      const TimelineScope outer("outer", 2);
      const TimelineScope inner("inner", 2);
    }
    const auto& spans = timeline_spans();
    ASSERT_EQ(spans.size(), 2u);
    EXPECT_STREQ(spans[0].stage, "inner");
    EXPECT_STREQ(spans[1].stage, "outer");
    EXPECT_LE(spans[1].begin_ms, spans[0].begin_ms);
    EXPECT_GE(spans[1].end_ms, spans[0].end_ms);
    EXPECT_EQ(spans[1].frame, 2u);
  }).join();
  EXPECT_FALSE(timeline_started());
}

}  // namespace
}  // namespace triptych
