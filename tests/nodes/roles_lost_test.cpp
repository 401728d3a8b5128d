// Three roles in one process that lose each other: every picture is right, and they come together again.
#include "tests/nodes/roles_rig.hpp"

namespace triptych::test {
namespace {

using namespace std::chrono_literals;

class LostRoles : public Roles {
 protected:
  /// The first connections of this pair of roles pass through `before`, with their count; later ones are
  /// whole.
  void spoil_first(Role caller, Role callee,
                   const std::function<bool(uint32_t connection, uint32_t message)>& before) {
    spoil = [=, made = std::make_shared<std::atomic<uint32_t>>(0)](
                Role from, Role to, std::shared_ptr<Connection> connection) -> std::shared_ptr<Connection> {
      if (from != caller || to != callee) return connection;
      const uint32_t number = (*made)++;
      if (number > 1) return connection;
      return std::make_shared<SpoiledConnection>(std::move(connection),
                                                 [=](uint32_t message) { return before(number, message); });
    };
  }
  void expect_all_together_again(const RenderNodeSummary& summary) const {
    EXPECT_GE(summary.epochs, 2u);
    EXPECT_GT(summary.fallback_frames, 0u);
    EXPECT_LT(summary.fallback_frames, summary.frames);
    ASSERT_FALSE(pictures.records.empty());
    EXPECT_FALSE(pictures.records.back().fallback) << "they did not come back";
  }
  /// Frames that take a while, so that whoever was lost has the time to come back.
  void slowly() {
    pictures.after = [](uint32_t) { std::this_thread::sleep_for(8ms); };
  }
};

TEST_F(LostRoles, a_connection_may_break_at_any_message) {
  constexpr uint32_t frames = 12, channels = 2, messages = 16;
  size_t lost = 0;
  for (const auto& [caller, callee] : {std::pair{Role::switch_0, Role::render},
                                       {Role::switch_1, Role::render},
                                       {Role::switch_1, Role::switch_0}}) {
    for (uint32_t channel = 0; channel < channels; ++channel) {
      for (uint32_t at = 0; at < messages; ++at) {
        SCOPED_TRACE(fmt::format("{} to {}, connection {}, message {}", role_name(caller), role_name(callee),
                                 channel, at));
        pictures.records.clear();
        spoil_first(caller, callee, [=](uint32_t connection, uint32_t message) {
          return connection != channel || message != at;
        });
        run_all(frames);
        expect_right_pictures(frames);
        EXPECT_EQ(mismatches(), 0u);
        lost += !first_loss().empty();
      }
    }
  }
  EXPECT_GT(lost, 30u) << "most of them are not messages of an epoch";
}

TEST_F(LostRoles, a_switch_node_that_is_lost_is_found_again) {
  slowly();
  spoil_first(Role::switch_0, Role::render,
              [](uint32_t connection, uint32_t message) { return connection != 1 || message != 9; });
  const RenderNodeSummary summary = run_all(120);
  expect_right_pictures(120);
  expect_all_together_again(summary);
  EXPECT_NE(first_loss().find("switch node"), std::string::npos) << first_loss();
}

TEST_F(LostRoles, packets_that_come_too_late_end_the_epoch) {
  slowly();
  timeout = 100ms;
  spoil_first(Role::switch_0, Role::render, [](uint32_t connection, uint32_t message) {
    if (connection == 1 && message == 9) std::this_thread::sleep_for(400ms);
    return true;
  });
  const RenderNodeSummary summary = run_all(160);
  expect_right_pictures(160);
  expect_all_together_again(summary);
  EXPECT_NE(first_loss().find("no progress for "), std::string::npos) << first_loss();
}

TEST_F(LostRoles, a_switch_node_that_leaves_in_order_is_done_without_and_may_come_again) {
  right();
  slowly();
  std::promise<void> left;
  const auto slow = pictures.after;
  pictures.after = [&](uint32_t number) {
    slow(number);
    if (number == 7) stopped(Role::switch_1) = true;
    if (number == 30) left.set_value();
  };
  auto render = start_render(120);
  auto switch_0 = start_switch(Role::switch_0), switch_1 = start_switch(Role::switch_1);
  const SwitchNodeSummary first = switch_1.get();
  EXPECT_GE(first.culled + first.represented, 6u);
  left.get_future().wait();
  auto successor = start_switch(Role::switch_1);
  const RenderNodeSummary summary = render.get();
  over = true;
  switch_0.get();
  EXPECT_GT(successor.get().culled, 0u);
  expect_right_pictures(120);
  expect_all_together_again(summary);
  // Who says it first: the one that leaves, or the other one, which lost it.
  EXPECT_NE(first_loss().find("told to end"), std::string::npos) << first_loss();
}

TEST_F(LostRoles, a_render_node_that_fails_is_replaced_where_it_was) {
  right();
  pictures.after = [](uint32_t number) {
    std::this_thread::sleep_for(8ms);
    if (number == 9) throw std::runtime_error("the disk is full");
  };
  auto failing = start_render(120);
  auto switch_0 = start_switch(Role::switch_0), switch_1 = start_switch(Role::switch_1);
  EXPECT_THROW(failing.get(), std::runtime_error);
  const RenderNodeSummary summary = start_render(120, 10).get();
  over = true;
  EXPECT_GE(switch_0.get().epochs, 2u);
  EXPECT_GE(switch_1.get().epochs, 2u);
  expect_right_pictures(120);
  EXPECT_EQ(pictures.records[10].lost, "the render node before this one ended");
  EXPECT_LT(summary.fallback_frames, summary.frames);
}

TEST_F(LostRoles, the_first_picture_waits_for_nobody) {
  right();
  slowly();
  gather = 0ms;
  auto render = start_render(160);
  std::this_thread::sleep_for(100ms);
  auto switch_0 = start_switch(Role::switch_0), switch_1 = start_switch(Role::switch_1);
  const RenderNodeSummary summary = render.get();
  over = true;
  switch_0.get();
  switch_1.get();
  expect_right_pictures(160);
  EXPECT_GE(summary.epochs, 1u);
  EXPECT_TRUE(pictures.records.front().fallback);
  EXPECT_NE(pictures.records.front().lost, "");
  EXPECT_FALSE(pictures.records.back().fallback) << "they never joined";
}

TEST_F(LostRoles, gathering_ends_and_the_render_node_begins_alone) {
  right();
  gather = 50ms;
  const RenderNodeSummary summary = start_render(6).get();
  expect_right_pictures(6);
  EXPECT_EQ(summary.fallback_frames, 6u);
}

TEST_F(LostRoles, a_search_that_fails_is_made_again) {
  searches_that_fail = 2;
  const RenderNodeSummary summary = run_all(24);
  expect_right_pictures(24);
  EXPECT_LT(searches_that_fail, 0);
  EXPECT_EQ(summary.fallback_frames, 0u);
}

TEST_F(LostRoles, a_switch_node_that_changes_while_nothing_is_drawn_is_there_for_the_next_frame) {
  right();
  constexpr uint32_t rest_at = 10;
  std::promise<void> resting;
  std::atomic<bool> over_with_it{false};
  pictures.after = [&](uint32_t number) {
    if (number + 1 == rest_at) resting.set_value();
  };
  rests = [&](uint32_t next) { return next == rest_at && !over_with_it; };
  auto render = start_render(40);
  auto switch_0 = start_switch(Role::switch_0), switch_1 = start_switch(Role::switch_1);
  resting.get_future().wait();
  stopped(Role::switch_1) = true;
  switch_1.get();
  auto successor = start_switch(Role::switch_1);
  std::this_thread::sleep_for(1500ms);  // until all three have met and are ready
  over_with_it = true;
  const RenderNodeSummary summary = render.get();
  over = true;
  switch_0.get();
  successor.get();
  expect_right_pictures(40);
  EXPECT_EQ(summary.fallback_frames, 0u) << first_loss();
  EXPECT_EQ(summary.epochs, 2u);
  EXPECT_LT(pictures.records[rest_at].frame_ms, 1000) << "a rest is no frame time";
}

}  // namespace
}  // namespace triptych::test
