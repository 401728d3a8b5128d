// What becomes of a role that does not do what its recording says.
#include "nodes/recorded_peers.hpp"

#include "base/error.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

using std::chrono::milliseconds;

Message camera_of(uint32_t frame) { return CameraMessage{frame, {}, false, false}; }
const Message its_sentinel = Sentinel{0, 0, 0, 0, 0, {}};

const RecordedMessage camera{0, false, Role::render, Channel::camera, camera_of(0)};
const RecordedMessage sentinel{0, true, Role::render, Channel::nodes, its_sentinel};
const RecordedMessage copy{0, true, Role::switch_1, Channel::nodes, its_sentinel};
const RecordedMessage next_camera{0, false, Role::render, Channel::camera, camera_of(1)};

class RecordedPeersOfASwitchNode : public testing::Test {
 protected:
  std::string error() {
    try {
      peers.finish();
    } catch (const Error& problem) {
      return problem.what();
    }
    return "";
  }
  std::optional<Delivery> receive() const { return mailbox->receive(milliseconds(2000)); }

  std::vector<Message> played;
  RecordedPeers peers{Role::switch_0,
                      {camera, sentinel, copy, next_camera},
                      "switch-0.recording",
                      [this](const RecordedMessage& message) {
                        if (!message.sent) played.push_back(message.message);
                      },
                      milliseconds(300)};
  std::unique_ptr<Mailbox> mailbox = peers.connect();
};

TEST_F(RecordedPeersOfASwitchNode, send_what_it_received_after_it_sent_what_came_before) {
  ASSERT_TRUE(receive());
  EXPECT_FALSE(mailbox->receive(milliseconds(100))) << "the second camera came before the sentinel";
  for (const Role peer : {Role::render, Role::switch_1})
    ASSERT_FALSE(mailbox->send(peer, Channel::nodes, its_sentinel));
  const std::optional<Delivery> second = receive();
  ASSERT_TRUE(second);
  EXPECT_EQ(std::get<CameraMessage>(std::get<Received>(*second).message).frame, 1u);
  EXPECT_EQ(error(), "");
  EXPECT_EQ(played, (std::vector<Message>{camera.message, next_camera.message}));
}

TEST_F(RecordedPeersOfASwitchNode, give_up_on_one_that_hangs) {
  ASSERT_TRUE(receive());
  for (int tries = 0; tries < 100 && !peers.failed(); ++tries)
    static_cast<void>(mailbox->receive(milliseconds(50)));
  EXPECT_TRUE(peers.failed());
  EXPECT_TRUE(error().starts_with("switch-0.recording: the role ")) << error();
}

TEST_F(RecordedPeersOfASwitchNode, say_that_it_ended_too_soon) {
  ASSERT_TRUE(receive());
  EXPECT_EQ(error(), "switch-0.recording: the role ended before the session did");
}

TEST(RecordedPeers, want_messages_of_both_peers) {
  EXPECT_THROW(RecordedPeers(Role::switch_0, {camera}, "x", [](const RecordedMessage&) {}), Error);
}

}  // namespace
}  // namespace triptych
