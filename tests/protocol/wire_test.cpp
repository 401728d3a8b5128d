// Messages come back as they were, and whatever happens to their bytes is noticed.
#include "protocol/wire.hpp"

#include "base/bytes.hpp"
#include "base/clock.hpp"
#include "base/hashing.hpp"
#include "tests/protocol/sample_messages.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

namespace triptych {
namespace {

std::string refusal_of(std::span<const std::byte> bytes) {
  try {
    decode(bytes, "peer");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The message's bytes with another body, under a checksum that fits: what a peer with a fault of its own
/// could send.
std::vector<std::byte> forged(const Message& message, std::span<const std::byte> body) {
  const auto bytes = encode(message);
  MessageHeader header;
  std::memcpy(&header, bytes.data(), header_bytes);
  header.body_bytes = static_cast<uint32_t>(body.size());
  const uint32_t fields[] = {header.tag, header.frame, header.body_bytes};
  header.checksum = static_cast<uint32_t>(hash_bytes(body, hash_values(std::span<const uint32_t>(fields))));
  ByteWriter out;
  out.write(header);
  out.write_all(body);
  return out.bytes();
}

TEST(Wire, every_type_of_message_comes_back) {
  const auto messages = sample_messages();
  ASSERT_EQ(messages.size(), std::variant_size_v<Message>);
  for (const Message& message : messages) {
    EXPECT_TRUE(decode(encode(message), "peer") == message) << message_name(message);
  }
}

TEST(Wire, an_orthographic_camera_comes_back_whether_or_not_it_is_the_last) {
  for (const bool last : {false, true}) {
    const Message message = CameraMessage{13, {sample_orthographic_view(), 1}, last};
    EXPECT_TRUE(decode(encode(message), "peer") == message);
  }
}

TEST(Wire, a_camera_names_what_is_hidden_a_section_effects_that_are_off_and_a_time_each_by_itself) {
  for (int which = 0; which < 16; ++which) {
    CameraMessage camera{13, {sample_view(), 1}};
    if ((which & 1) != 0) camera.state.hiding.name = {100'000, 0xfedcba9876543210};
    if ((which & 2) != 0) camera.state.section = sample_section();
    if ((which & 4) != 0) camera.state.effects = Effects(1);
    if ((which & 8) != 0) camera.state.time = -1 / 3.0;
    EXPECT_TRUE(decode(encode(camera), "peer") == Message(camera)) << which;
  }
}

TEST(Wire, a_camera_that_switches_off_what_is_not_known_is_refused) {
  CameraMessage camera{13, {sample_view(), 1}};
  camera.state.effects = Effects::none();
  std::vector<std::byte> bytes = encode(camera);
  EXPECT_NO_THROW(decode(bytes, "peer"));
  for (const auto off : {std::byte{0}, std::byte{4}}) {
    bytes.back() = off;
    EXPECT_THROW(decode(bytes, "peer"), Error) << static_cast<int>(off);
  }
}

TEST(Wire, a_hidden_set_is_small_where_it_is_one_object_and_where_it_is_every_second) {
  HiddenSet one{3, {50'000}}, second{3, {}};
  for (uint32_t id = 0; id < 100'000; id += 2) second.objects.push_back(id);
  EXPECT_LE(encode(one).size(), header_bytes + 8);
  EXPECT_LE(encode(second).size(), header_bytes + 2048);
  EXPECT_TRUE(decode(encode(second), "peer") == Message(second));
}

TEST(Wire, a_name_or_a_set_of_nothing_hidden_is_refused) {
  EXPECT_THROW(decode(encode(HiddenSet{3, {}}), "peer"), Error);
  CameraMessage camera{13, {sample_view(), 1}};
  camera.state.hiding.name = {0, 7};
  EXPECT_THROW(decode(encode(camera), "peer"), Error);
}

RC_GTEST_PROP(Wire, deltas_come_back_with_their_watermark,
              (uint32_t frame, uint64_t distance, uint32_t id, std::set<DrawableId> added)) {
  const auto encoded = encode_delta({{added.begin(), added.end()}, {}}, {});
  const Message message = DeltaMessage{frame, {distance, id}, encoded};
  RC_ASSERT(decode(encode(message), "peer") == message);
}

TEST(Wire, a_delta_after_which_everything_is_decided_spends_nothing_on_its_watermark) {
  const auto encoded = encode_delta({{5, 6}, {}}, {});
  const Message message = DeltaMessage{3, everything_decided, encoded};
  const auto bytes = encode(message);
  EXPECT_EQ(bytes.size(), header_bytes + encoded.size());
  EXPECT_TRUE(decode(bytes, "peer") == message);
}

TEST(Wire, bodies_are_as_long_as_documented) {
  CameraMessage walk{1, {}, true, false};
  walk.state.view.width = walk.state.view.height = 512;
  walk.state.view.camera = {.eye = {1 / 3.0, 2 / 3.0, 4 / 3.0},
                            .target = {1 / 7.0, 2 / 7.0, 3 / 7.0},
                            .up = {0, 1, 0},
                            .near = 0.1};
  set_field_of_view(walk.state.view.camera, 60, 1);
  EXPECT_EQ(encode(walk).size(), header_bytes + 88) << "camera";
  walk.state.view.camera.left *= 2;
  EXPECT_EQ(encode(walk).size(), header_bytes + 88 + 1 + 16) << "camera of a lopsided frustum";
  FrameState& longest = walk.state;
  longest.view.width = longest.view.height = 32768;
  longest.view.camera.up = {1 / 3.0, 0.1, 0.7};
  longest.view.camera.top *= 3;
  longest.pixel_error = 1 / 3.0;
  for (uint32_t i = 0; i < Section::max_planes; ++i)
    longest.section.add_plane({{1, 0.3, 0.7}, 1 / 3.0}, "test");
  longest.section.set_box({glm::dvec3(-0.1), glm::dvec3(0.1)}, "test");
  longest.hiding.name = {no_id, ~uint64_t{0}};
  longest.effects = Effects::none();
  longest.time = 1 / 3.0;
  longest.sky = {true, {1 / 3.0, 2 / 3.0, -2 / 3.0}};
  EXPECT_EQ(encode(walk).size(), header_bytes + 441) << "the longest camera";
  const Sentinel sentinel{.frame = 1,
                          .visible = 60,
                          .added = 2,
                          .removed = 2,
                          .digest = 7,
                          .times = {.hardware_cull_ms = to_the_microsecond(20.1),
                                    .hardware_cull_cpu_ms = to_the_microsecond(9.7),
                                    .queries = 200,
                                    .cut_size = 900,
                                    .sent_at_ms = 0}};
  EXPECT_LE(encode(sentinel).size(), header_bytes + 8 + 3 + 2 + 2 + 1 + 9) << "sentinel";
  EXPECT_EQ(encode(FullSetRequest{1}).size(), header_bytes) << "full set request";
}

TEST(Wire, a_number_has_one_encoding) {
  ByteWriter body;
  body.write(uint8_t{8});
  body.write(1.0);
  EXPECT_NE(refusal_of(forged(ClockAnswer{}, body.bytes())).find("a needless byte"), std::string::npos);
  ByteWriter longer;
  longer.write(uint8_t{9});
  longer.write(1.0);
  longer.write(uint8_t{1});
  EXPECT_NE(refusal_of(forged(ClockAnswer{}, longer.bytes())).find("a number of 9 bytes"), std::string::npos);
}

RC_GTEST_PROP(Wire, cameras_come_back_to_the_bit, (uint32_t frame, bool last)) {
  const auto finite = [] {
    return *rc::gen::suchThat(rc::gen::arbitrary<double>(),
                              [](double value) { return std::abs(value) < 1e100; });
  };
  CameraMessage message{
      frame,
      {sample_view(), std::abs(finite()), *rc::gen::element(1u, 4u, 8u, 16u), *rc::gen::arbitrary<bool>()},
      last};
  message.state.view.camera.eye = {finite(), finite(), finite()};
  message.state.view.camera.target =
      message.state.view.camera.eye + glm::dvec3(std::abs(message.state.view.camera.eye.x) + 1, 0, 0);
  message.state.view.width = *rc::gen::inRange(1, 32769);
  message.state.view.height = *rc::gen::inRange(1, 32769);
  RC_ASSERT(decode(encode(message), "peer") == Message(message));
}

RC_GTEST_PROP(Wire, any_bytes_are_a_message_or_refused, (std::vector<uint8_t> noise)) {
  try {
    decode(std::as_bytes(std::span<const uint8_t>(noise)), "peer");
    RC_FAIL("noise passed for a message");
  } catch (const Error&) {
    RC_SUCCEED("refused");
  }
}

RC_GTEST_PROP(Wire, any_body_under_a_right_checksum_is_read_or_refused, (std::vector<uint8_t> noise)) {
  const auto body = std::as_bytes(std::span<const uint8_t>(noise));
  for (const Message& message : sample_messages()) {
    try {
      const Message read = decode(forged(message, body), "peer");
      RC_ASSERT(read.index() == message.index());
    } catch (const Error&) {
      RC_ASSERT(!std::holds_alternative<FullSetRequest>(message) || !noise.empty());
    }
  }
}

TEST(Wire, every_truncation_is_refused) {
  for (const Message& message : sample_messages()) {
    const auto bytes = encode(message);
    for (size_t length = 0; length < bytes.size(); ++length) {
      EXPECT_NE(refusal_of(std::span(bytes).first(length)), "") << message_name(message) << " at " << length;
    }
  }
}

TEST(Wire, every_flipped_bit_is_refused) {
  for (const Message& message : sample_messages()) {
    const auto bytes = encode(message);
    for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      auto flipped = bytes;
      flipped[bit / 8] ^= std::byte{1} << (bit % 8);
      EXPECT_NE(refusal_of(flipped), "") << message_name(message) << " at bit " << bit;
    }
  }
}

TEST(Wire, every_changed_body_under_a_right_checksum_is_read_or_refused) {
  for (const Message& message : sample_messages()) {
    const auto bytes = encode(message);
    const auto body = std::span(bytes).subspan(header_bytes);
    const size_t shortest = std::holds_alternative<FullSet>(message) ? 1 : 0;  // no bytes are the empty set
    for (size_t length = shortest; length < body.size(); ++length) {
      if (!std::holds_alternative<Bye>(message) && !std::holds_alternative<DeltaMessage>(message)) {
        EXPECT_NE(refusal_of(forged(message, body.first(length))), "")
            << message_name(message) << " at " << length;
      }
    }
    for (size_t i = 0; i < body.size(); ++i) {
      for (const int value : {0x00, 0x01, 0x7f, 0x80, 0xff}) {
        std::vector<std::byte> changed(body.begin(), body.end());
        changed[i] = static_cast<std::byte>(value);
        refusal_of(forged(message, changed));  // must come back at all; the sanitizers watch
      }
    }
  }
}

TEST(Wire, bytes_after_the_body_are_refused) {
  for (const Message& message : sample_messages()) {
    auto bytes = encode(message);
    bytes.push_back(std::byte{0});
    EXPECT_NE(refusal_of(bytes), "") << message_name(message);
  }
}

TEST(Wire, a_length_beyond_the_limit_is_refused_by_the_header_alone) {
  auto bytes = encode(FullSetRequest{3});
  const uint32_t length = body_limit + 1;
  std::memcpy(bytes.data() + 8, &length, sizeof(length));
  try {
    decode_header(std::span(bytes).first<header_bytes>(), "peer");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "peer: frame 3: a message of 67108865 bytes, at most 67108864 are allowed");
  }
}

TEST(Wire, refusals_name_the_peer_and_the_frame) {
  auto bytes = encode(sample_messages()[3]);
  bytes.back() ^= std::byte{1};
  EXPECT_EQ(refusal_of(bytes), "peer: frame 12: a message with a wrong checksum");
}

TEST(Wire, a_camera_without_a_direction_is_refused) {
  CameraMessage message{1, {sample_view(), 1}};
  message.state.view.camera.target = message.state.view.camera.eye;
  EXPECT_NE(refusal_of(encode(message)).find("no direction"), std::string::npos);
}

TEST(Wire, a_camera_that_is_not_a_number_is_refused) {
  CameraMessage message{1, {sample_view(), 1}};
  message.state.view.camera.eye.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal_of(encode(message)), "");
  message = {1, {sample_view(), std::numeric_limits<double>::infinity()}};
  EXPECT_NE(refusal_of(encode(message)), "");
  message = {1, {sample_view(), 1}};
  message.state.view.width = 0;
  EXPECT_NE(refusal_of(encode(message)), "");
}

TEST(Wire, of_a_hello_of_another_version_only_the_beginning_is_read) {
  ByteWriter body;
  body.write(protocol_version + 1);
  body.write(Role::switch_0);
  body.write(Channel::nodes);
  body.write(Role::render);
  body.write_text("whatever comes with that version");
  const Message message = decode(forged(Hello{}, body.bytes()), "peer");
  const auto& hello = std::get<Hello>(message);
  EXPECT_EQ(hello.version, protocol_version + 1);
  EXPECT_EQ(hello.role, Role::switch_0);
  EXPECT_EQ(hello.channel, Channel::nodes);
}

TEST(Wire, texts_arrive_as_one_short_line) {
  const Message message = decode(encode(Bye{"first\nsecond\x1b[31m" + std::string(5000, 'x')}), "peer");
  const auto& reason = std::get<Bye>(message).reason;
  EXPECT_EQ(reason.substr(0, 17), "first second [31m");
  EXPECT_EQ(reason.size(), text_limit);
  ByteWriter body;
  body.write_text("two\nlines");
  EXPECT_NE(refusal_of(forged(Bye{}, body.bytes())), "");
}

}  // namespace
}  // namespace triptych
