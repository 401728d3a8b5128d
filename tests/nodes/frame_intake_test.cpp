// One frame's visible set taken in from HC: whole, in order, checked, and asked for again where it differs.
#include "nodes/frame_intake.hpp"

#include "protocol/delta_codec.hpp"
#include "protocol/digest.hpp"
#include "protocol/memory_connection.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>
#include <thread>

namespace triptych {
namespace {

/// The render node, connected to a switch node 0 that says what the test wants.
class FrameIntake : public testing::Test {
 protected:
  FrameIntake() {
    for (const Channel channel : all_channels) {
      constexpr size_t capacity = 1 << 20;  // nobody reads while one side says what the test wants
      const auto [caller, callee] = memory_pair(switch_0.context(), render.context(), capacity);
      render.add(Role::switch_0, channel, callee);
      switch_0.add(Role::render, channel, caller);
    }
    for (DrawableId id = 0; id < skeleton.drawables.size(); ++id) {
      if (id % 3 != 0) previous.push_back(id);
      if (id % 4 != 1) visible.push_back(id);
    }
    frame = {0, {scenes::path(skeleton, 64, 64).front(), 1}};
  }

  void send(const Message& message) { EXPECT_FALSE(switch_0.send(Role::render, Channel::nodes, message)); }
  void send_delta(const VisibleDelta& delta, const DrawRank& watermark = everything_decided) {
    send(DeltaMessage{0, watermark, encode_delta(delta, previous)});
  }
  void send_sentinel() {
    Sentinel sentinel;
    sentinel.digest = frame_digest(0, frame.state.view, frame.state.pixel_error, pack_hash, visible);
    send(sentinel);
  }
  Awaited<IntakeResult> try_to_take(const SessionRules& rules = {}) {
    return take_frame(
        inbox, skeleton, pack_hash, frame, previous,
        [&](const std::vector<DrawableId>& fresh) {
          decided.insert(decided.end(), fresh.begin(), fresh.end());
        },
        rules);
  }
  /// A frame that is whole.
  IntakeResult take(const SessionRules& rules = {}) {
    Awaited<IntakeResult> result = try_to_take(rules);
    EXPECT_TRUE(result) << result.ending().reason;
    return result ? *result : IntakeResult{};
  }
  /// What ends the intake.
  Ending ending() {
    const Awaited<IntakeResult> result = try_to_take();
    EXPECT_FALSE(result) << "the frame was taken";
    return result ? Ending{} : result.ending();
  }
  /// Whether the render node asked for the whole set.
  bool was_asked() {
    const auto delivery = switch_0.receive(std::chrono::milliseconds(200));
    const auto* received = delivery ? std::get_if<Received>(&*delivery) : nullptr;
    return received && std::holds_alternative<FullSetRequest>(received->message);
  }

  const Skeleton& skeleton = scenes::pack("room").skeleton();
  const uint64_t pack_hash = 77;
  FrameRequest frame;
  VisibleSet previous, visible;
  Mailbox render, switch_0;
  Inbox inbox{render};
  std::vector<DrawableId> decided;
};

TEST_F(FrameIntake, gives_the_set_and_each_drawable_of_it_once_in_draw_rank_order) {
  const glm::ivec3 cell = eye_cell(skeleton, frame.state.view);
  const DrawRank middle = draw_rank(skeleton, cell, visible[visible.size() / 2]);
  VisibleDelta near_part, far_part;
  const VisibleDelta delta = difference(previous, visible);
  for (const auto list : {&VisibleDelta::added, &VisibleDelta::removed}) {
    for (const DrawableId id : delta.*list) {
      (draw_rank(skeleton, cell, id) < middle ? near_part.*list : far_part.*list).push_back(id);
    }
  }
  send_delta(near_part, middle);
  send_delta(far_part);
  send_sentinel();
  const IntakeResult result = take();
  EXPECT_EQ(result.visible, visible);
  EXPECT_FALSE(result.digest_mismatch);
  EXPECT_FALSE(was_asked());
  std::vector<DrawableId> expected = visible;
  sort_by_rank(skeleton, cell, expected);
  EXPECT_EQ(decided, expected);
}

TEST_F(FrameIntake, asks_for_the_whole_set_where_the_digest_differs) {
  VisibleDelta wrong = difference(previous, visible);
  wrong.added.pop_back();
  send_delta(wrong);
  send_sentinel();
  send(FullSet{0, visible});
  const IntakeResult result = take();
  EXPECT_TRUE(result.digest_mismatch);
  EXPECT_EQ(result.visible, visible);
  EXPECT_TRUE(was_asked());
}

TEST_F(FrameIntake, asks_for_the_whole_set_where_a_delta_makes_no_sense) {
  send(DeltaMessage{0, everything_decided, std::vector<std::byte>(40, std::byte{0xa5})});
  send_sentinel();
  send(FullSet{0, visible});
  const IntakeResult result = take();
  EXPECT_TRUE(result.digest_mismatch);
  EXPECT_EQ(result.visible, visible);
}

TEST_F(FrameIntake, refuses_a_whole_set_that_is_wrong_too) {
  send_delta({});
  send_sentinel();
  send(FullSet{0, previous});
  const Ending end = ending();
  EXPECT_EQ(end.cause, Ending::Cause::peer_lost);
  EXPECT_EQ(end.peer, Role::switch_0);
  EXPECT_NE(end.reason.find("does not match its digest either"), std::string::npos) << end.reason;
}

TEST_F(FrameIntake, believes_anything_without_digests) {
  send_delta({});
  send_sentinel();
  const IntakeResult result = take({.compares_digests = false});
  EXPECT_FALSE(result.digest_mismatch);
  EXPECT_EQ(result.visible, previous);
}

TEST_F(FrameIntake, keeps_messages_of_later_frames_for_later) {
  send(DeltaMessage{2, everything_decided, encode_delta({}, previous)});
  send_delta(difference(previous, visible));
  send_sentinel();
  EXPECT_EQ(take().visible, visible);
  EXPECT_TRUE(std::holds_alternative<DeltaMessage>(*inbox.packet(2)));
}

TEST_F(FrameIntake, ends_in_an_error_where_the_switch_node_leaves_in_trouble) {
  send_delta({});
  switch_0.leave("its graphics card is on fire");
  const Ending end = ending();
  EXPECT_EQ(end.cause, Ending::Cause::peer_lost);
  EXPECT_NE(end.reason.find("its graphics card is on fire"), std::string::npos) << end.reason;
}

TEST_F(FrameIntake, ends_without_an_error_where_the_switch_node_just_leaves) {
  switch_0.leave("");
  EXPECT_EQ(ending().cause, Ending::Cause::session_over);
}

TEST_F(FrameIntake, a_peer_that_sends_without_end_what_nobody_waits_for_is_lost) {
  // Reports of frames to come, until the inbox is full.
  for (uint32_t i = 0; i <= inbox_limit.messages; ++i) {
    SwitchReport report;
    report.frame = i;
    send(report);
  }
  const Ending end = ending();
  EXPECT_EQ(end.cause, Ending::Cause::peer_lost);
  EXPECT_EQ(end.peer, Role::switch_0);
  EXPECT_NE(end.reason.find("nobody waits"), std::string::npos) << end.reason;
  EXPECT_LE(render.max_backlog().messages, inbox_limit.messages + mailbox_limit.messages);
}

TEST_F(FrameIntake, what_nobody_waits_for_is_kept_up_to_a_size) {
  std::thread sender([&] {
    std::optional<PeerLost> lost;
    for (uint32_t i = 1; i <= 6 && !lost; ++i) {
      lost = switch_0.send(Role::render, Channel::nodes,
                           DeltaMessage{i, everything_decided, std::vector<std::byte>(size_t{60} << 20)});
    }
  });
  EXPECT_EQ(ending().cause, Ending::Cause::peer_lost);
  render.leave("");
  sender.join();
}

}  // namespace
}  // namespace triptych
