// Encryption without sockets: two ends that know the same key understand each other, and nobody else does.
#include "protocol/tls.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

namespace triptych {
namespace {

SharedKey key_of(unsigned char seed) {
  SharedKey key;
  key.bytes.fill(seed);
  return key;
}

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// Carries what each side has to say to the other until neither has anything.
void shake_hands(TlsStream& caller, TlsStream& callee) {
  std::vector<std::byte> nothing;
  for (int turn = 0; turn < 10; ++turn) {
    callee.take(caller.to_send(), nothing);
    caller.take(callee.to_send(), nothing);
  }
  EXPECT_TRUE(nothing.empty());
}

class Tls : public testing::Test {
 protected:
  TlsStream caller{key_of(1), TlsStream::Side::caller}, callee{key_of(1), TlsStream::Side::callee};
  std::vector<std::byte> heard;
};

TEST_F(Tls, both_ends_understand_each_other) {
  EXPECT_FALSE(caller.established());
  shake_hands(caller, callee);
  ASSERT_TRUE(caller.established());
  ASSERT_TRUE(callee.established());
  const auto secret = bytes_of("what nobody else may read");
  const auto sealed = caller.seal(secret);
  EXPECT_EQ(std::search(sealed.begin(), sealed.end(), secret.begin(), secret.end()), sealed.end());
  callee.take(sealed, heard);
  EXPECT_EQ(heard, secret);
  heard.clear();
  const std::vector<std::byte> large(3'000'000, std::byte{7});
  caller.take(callee.seal(large), heard);
  EXPECT_EQ(heard, large);
}

TEST_F(Tls, bytes_may_come_one_by_one) {
  std::vector<std::byte> nothing;
  for (int turn = 0; turn < 4; ++turn) {
    for (const std::byte byte : caller.to_send()) callee.take({&byte, 1}, nothing);
    for (const std::byte byte : callee.to_send()) caller.take({&byte, 1}, nothing);
  }
  ASSERT_TRUE(callee.established());
  for (const std::byte byte : caller.seal(bytes_of("slowly"))) callee.take({&byte, 1}, heard);
  EXPECT_EQ(heard, bytes_of("slowly"));
}

TEST_F(Tls, another_key_ends_the_handshake) {
  TlsStream stranger(key_of(2), TlsStream::Side::caller);
  EXPECT_THROW(shake_hands(stranger, callee), Error);
  EXPECT_FALSE(callee.established());
}

TEST_F(Tls, a_changed_byte_is_noticed) {
  shake_hands(caller, callee);
  auto sealed = caller.seal(bytes_of("a message"));
  sealed[sealed.size() / 2] ^= std::byte{1};
  EXPECT_THROW(callee.take(sealed, heard), Error);
  EXPECT_TRUE(heard.empty());
}

TEST_F(Tls, what_is_no_handshake_is_refused) {
  EXPECT_THROW(callee.take(bytes_of("GET / HTTP/1.1\r\n\r\n"), heard), Error);
}

TEST_F(Tls, nothing_is_said_before_the_handshake_is_over) {
  EXPECT_THROW(caller.seal(bytes_of("too early")), Error);
}

class KeyFile : public testing::Test {
 protected:
  ~KeyFile() override { std::filesystem::remove(file); }
  void write(const std::string& text) const {
    std::ofstream(file, std::ios::binary) << text;
    std::filesystem::permissions(file,
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  }
  std::string refusal() const {
    try {
      read_key_file(file);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("triptych_key_" + std::to_string(::getpid()));
};

TEST_F(KeyFile, is_the_same_with_and_without_a_line_end) {
  write(std::string(64, 'a'));
  const auto once = read_key_file(file).bytes;
  write(std::string(64, 'a') + "\n");
  EXPECT_EQ(read_key_file(file).bytes, once);
  write(std::string(63, 'a') + "b");
  EXPECT_NE(read_key_file(file).bytes, once);
}

TEST_F(KeyFile, that_is_short_missing_or_open_to_others_is_refused) {
  EXPECT_NE(refusal(), "");
  write("short");
  EXPECT_NE(refusal().find("at least 32"), std::string::npos) << refusal();
  write(std::string(64, 'a'));
  std::filesystem::permissions(file, std::filesystem::perms::group_read, std::filesystem::perm_options::add);
  EXPECT_NE(refusal().find("others may read"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace triptych
