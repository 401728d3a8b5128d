// Three roles in one process while what is hidden changes: every picture is right, whoever is lost.
#include "protocol/message_bodies.hpp"
#include "tests/nodes/roles_rig.hpp"
#include "tests/support/object_sets.hpp"

namespace triptych::test {
namespace {

using namespace std::chrono_literals;

/// Does not send the fifth hidden set, whichever connection it comes to: the first two are of the warm-up.
/// Each write is a message.
class DroppingConnection : public SpoiledConnection {
 public:
  DroppingConnection(std::shared_ptr<Connection> below, std::shared_ptr<std::atomic<int>> sets)
      : SpoiledConnection(std::move(below), [](uint32_t) { return true; }), sets_(std::move(sets)) {}
  std::string write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) override {
    const auto type = static_cast<std::byte>(type_of(HiddenSet{}));
    if (bytes[3] == type && (*sets_)++ == 4) return "";
    return SpoiledConnection::write(bytes, timeout);
  }

 private:
  std::shared_ptr<std::atomic<int>> sets_;
};

class HidingRoles : public Roles {
 protected:
  HidingRoles() {
    like_frame = [](FrameRequest& frame) {
      frame.state.hiding = hidings()[frame.number / 3 % hidings().size()];
    };
  }

  /// What frames hide in turn, three of them each; nothing among them.
  static const std::vector<Hiding>& hidings() {
    static const std::vector<Hiding> all = [] {
      const PackObjects objects = pack().read_objects();
      scenes::Random random(3);
      std::vector<Hiding> made;
      for (int i = 0; i < 8; ++i)
        made.push_back(
            hide(pack().skeleton(), objects, random_set(random, objects.source().objects.size()), "test"));
      return made;
    }();
    return all;
  }
  void expect_right_pictures_with_hidden_sets(uint32_t count) {
    const auto expected = thread(Role::render).run([this, count] { return whole_cuts(count); }).get();
    ASSERT_EQ(pictures.records.size(), count);
    for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(pictures.records[i].picture_hash, expected[i]) << i;
    size_t different = 0;
    for (uint32_t i = 0; i < count; ++i) different += expected[i] != right()[i % right().size()];
    EXPECT_GT(different, count / 4) << "hiding changes hardly any picture";
  }
  std::vector<uint64_t> whole_cuts(uint32_t count) const {
    LocalPipeline pipeline(
        pack(), {.width = side, .height = side, .cull = StrategyKind::frustum, .device = wanted_device()});
    std::vector<uint64_t> hashes;
    for (uint32_t i = 0; i < count; ++i) {
      FrameRequest frame{i, {views()[i % views().size()]}};
      like_frame(frame);
      pipeline.draw(frame);
      const auto colors = pipeline.target().read_colors();
      hashes.push_back(hash_values(std::span<const uint8_t>(colors)));
    }
    return hashes;
  }
};

TEST_F(HidingRoles, draw_every_frame_together) {
  const RenderNodeSummary summary = run_all(48);
  expect_right_pictures_with_hidden_sets(48);
  EXPECT_EQ(summary.fallback_frames, 0u);
  EXPECT_EQ(mismatches(), 0u);
}

/// What a person changes goes into the next frame that is released, and its picture is the second from then
/// on.
TEST_F(HidingRoles, what_is_hidden_is_gone_from_the_second_picture_on) {
  const std::function<void(FrameRequest&)> hides = like_frame;
  size_t changes = 0, latest = 0;
  like_frame = [&](FrameRequest& frame) {
    hides(frame);
    if (frame.number == 0 || frame.number % 3 != 0) return;
    ++changes;
    latest = std::max(latest, frame.number + 1 - pictures.records.size());
  };
  run_all(48);
  EXPECT_EQ(changes, 15u);
  EXPECT_GE(latest, 1u);
  EXPECT_LE(latest, 2u) << "pictures from the change to the one that shows it";
  like_frame = hides;
  expect_right_pictures_with_hidden_sets(48);
}

TEST_F(HidingRoles, a_switch_node_that_comes_again_gets_what_is_hidden) {
  timeout = 500ms;
  pictures.after = [this](uint32_t number) {
    std::this_thread::sleep_for(8ms);
    if (number == 10) stopped(Role::switch_1) = true;
  };
  right();
  over = false;
  auto render = start_render(200);
  auto switch_0 = start_switch(Role::switch_0), switch_1 = start_switch(Role::switch_1);
  switch_1.get();
  auto again = start_switch(Role::switch_1);
  const RenderNodeSummary summary = render.get();
  over = true;
  switch_0.get();
  EXPECT_GT(again.get().culled, 0u);
  EXPECT_GE(summary.epochs, 2u);
  EXPECT_GT(summary.fallback_frames, 0u);
  EXPECT_LT(summary.fallback_frames, 150u) << "it did not come back";
  expect_right_pictures_with_hidden_sets(200);
  EXPECT_EQ(mismatches(), 0u);
}

TEST_F(HidingRoles, a_set_that_is_lost_ends_the_epoch_and_no_picture_is_wrong) {
  auto sets = std::make_shared<std::atomic<int>>(0);
  equip = [sets](Role role, Mailbox& mailbox) {
    if (role == Role::render)
      mailbox.wrap(Channel::camera, [sets](std::shared_ptr<Connection> connection) {
        return std::make_shared<DroppingConnection>(std::move(connection), sets);
      });
  };
  pictures.after = [](uint32_t) { std::this_thread::sleep_for(8ms); };
  const RenderNodeSummary summary = run_all(96);
  EXPECT_GT(sets->load(), 5);
  EXPECT_GE(summary.epochs, 2u);
  EXPECT_NE(first_loss(), "");
  expect_right_pictures_with_hidden_sets(96);
}

}  // namespace
}  // namespace triptych::test
