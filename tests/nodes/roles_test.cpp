// Three roles in one process: what a session does when all is well, and when somebody is not who he should
// be.
#include "protocol/flipping_connection.hpp"
#include "tests/nodes/roles_rig.hpp"

namespace triptych::test {
namespace {

using namespace std::chrono_literals;

TEST_F(Roles, draw_every_frame_together) {
  const RenderNodeSummary summary = run_all(24);
  expect_right_pictures(24);
  EXPECT_EQ(summary.frames, 24u);
  EXPECT_EQ(summary.fallback_frames, 0u);
  EXPECT_EQ(summary.epochs, 1u);
  EXPECT_EQ(mismatches(), 0u);
  EXPECT_EQ(pictures.endings, std::vector<std::string>{""});
  EXPECT_EQ(pictures.clocks_heard, 2u);
  EXPECT_EQ(switches[0].culled, 12u);
  EXPECT_EQ(switches[1].culled, 12u);
  EXPECT_EQ(switches[0].epochs, 1u);
}

TEST_F(Roles, draw_every_frame_with_samples_and_edges) {
  for (const uint32_t samples : {4u, 16u}) {
    like.samples = samples;
    like.edges = samples == 4;
    pictures.records.clear();
    const auto expected = thread(Role::render).run([this] { return whole_cuts(like); }).get();
    const RenderNodeSummary summary = run_all(12);
    EXPECT_EQ(summary.fallback_frames, 0u);
    EXPECT_EQ(mismatches(), 0u);
    ASSERT_EQ(pictures.records.size(), 12u);
    for (size_t i = 0; i < 12; ++i) EXPECT_EQ(pictures.records[i].picture_hash, expected[i]) << i;
    EXPECT_NE(expected[0], right()[0]);
  }
}

TEST_F(Roles, a_wrong_delta_is_told_by_its_digest_and_never_shown) {
  rules[1].withholds_added = rules[2].withholds_added = true;
  const RenderNodeSummary summary = run_all(24);
  expect_right_pictures(24);
  EXPECT_GT(mismatches(), 0u);
  EXPECT_EQ(summary.fallback_frames, 0u) << "the full set was sent";
}

TEST_F(Roles, a_wrong_delta_without_digests_changes_pictures) {
  rules[1].withholds_added = rules[2].withholds_added = true;
  for (SessionRules& rule : rules) rule.compares_digests = false;
  run_all(24);
  ASSERT_EQ(pictures.records.size(), 24u);
  EXPECT_EQ(mismatches(), 0u);
  size_t wrong = 0;
  for (uint32_t i = 0; i < 24; ++i) wrong += pictures.records[i].picture_hash != right()[i];
  EXPECT_GT(wrong, 0u);
}

TEST_F(Roles, flipped_bytes_are_noticed_and_never_shown) {
  equip = [](Role, Mailbox& mailbox) {
    mailbox.wrap(Channel::nodes, [](std::shared_ptr<Connection> connection) {
      return flipping_connection(std::move(connection), 20);
    });
  };
  pictures.after = [](uint32_t) { std::this_thread::sleep_for(5ms); };
  run_all(72);
  expect_right_pictures(72);
  EXPECT_NE(first_loss(), "");
}

TEST_F(Roles, slow_roles_change_no_picture) {
  for (const size_t slow : {0u, 2u}) {
    pictures.records.clear();
    rules = {};
    rules[slow].slowed_by = 5ms;
    const RenderNodeSummary summary = run_all(12);
    expect_right_pictures(12);
    EXPECT_EQ(summary.fallback_frames, 0u);
  }
}

TEST_F(Roles, a_switch_node_with_another_pack_is_refused_and_does_not_keep_the_right_one_away) {
  right();
  auto render = start_render(12);
  Hello odd = hello(Role::switch_0);
  odd.pack_hash = 1;
  auto refused = start_switch(odd);
  try {
    refused.get();
    FAIL() << "it was let in";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("pack differs: "), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("render node has "), std::string::npos) << error.what();
  }
  auto switch_0 = start_switch(Role::switch_0), switch_1 = start_switch(Role::switch_1);
  EXPECT_EQ(render.get().fallback_frames, 0u);
  over = true;
  switch_0.get();
  switch_1.get();
  expect_right_pictures(12);
}

TEST_F(Roles, a_session_that_is_told_to_end_before_it_began_draws_nothing) {
  auto render = start_render(12);
  std::this_thread::sleep_for(100ms);
  stopped(Role::render) = true;
  EXPECT_EQ(render.get().frames, 0u);
}

TEST_F(Roles, a_render_node_that_is_told_to_end_tells_the_switch_nodes) {
  pictures.after = [this](uint32_t number) { stopped(Role::render) = number == 7; };
  auto render = start_render(1000);
  auto switch_0 = start_switch(Role::switch_0), switch_1 = start_switch(Role::switch_1);
  EXPECT_EQ(render.get().frames, 8u);
  switch_0.get();  // without being told otherwise
  switch_1.get();
  EXPECT_EQ(pictures.endings, std::vector<std::string>{""});
}

}  // namespace
}  // namespace triptych::test
