// Encryption over connections within the process: two ends that know the same key understand each other, and
// nobody else does.
#include "protocol/tls.hpp"

#include "base/error.hpp"
#include "protocol/memory_connection.hpp"

#include <algorithm>
#include <asio/executor_work_guard.hpp>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <unistd.h>

namespace triptych {
namespace {

using namespace std::chrono_literals;

SharedKey key_of(unsigned char seed) {
  SharedKey key;
  key.bytes.fill(seed);
  return key;
}

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// Keeps what is written, changes a byte of it where the test says so, and hands on what is read a few bytes
/// at a time.
class Tapped : public Connection {
 public:
  explicit Tapped(std::shared_ptr<Connection> below) : below_(std::move(below)) {}
  void read_some(std::span<std::byte> into, Read done) override {
    below_->read_some(into.first(std::min(into.size(), piece)), std::move(done));
  }
  std::string write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) override {
    std::vector<std::byte> sent(bytes.begin(), bytes.end());
    if (flips) sent[sent.size() / 2] ^= std::byte{1};
    written.insert(written.end(), sent.begin(), sent.end());
    return below_->write(sent, timeout);
  }
  void close() override { below_->close(); }
  asio::io_context& context() override { return below_->context(); }
  const std::string& place() const override { return below_->place(); }

  size_t piece = 100'000;
  bool flips = false;
  std::vector<std::byte> written;

 private:
  std::shared_ptr<Connection> below_;
};

class Tls : public testing::Test {
 protected:
  Tls() {
    auto [one, other] = memory_pair(context, context);
    tap = std::make_shared<Tapped>(one);
    plain_callee = other;
  }
  ~Tls() override {
    if (caller) caller->close();
    if (callee) callee->close();
    tap->close();
    plain_callee->close();
    context.run_for(10ms);
  }
  void encrypt(const SharedKey& callers = key_of(1)) {
    caller = tls_connection(tap, callers, TlsSide::caller);
    callee = tls_connection(plain_callee, key_of(1), TlsSide::callee);
  }
  /// Both handshakes; what is wrong with either. The callee hears first where the key is wrong.
  void shake_hands() {
    caller->open([this](const std::string& problem) { caller_problem = problem; });
    callee->open([this](const std::string& problem) { callee_problem = problem; });
    for (int tries = 0; tries < 1000 && !(caller_problem && callee_problem); ++tries) context.run_for(5ms);
    ASSERT_TRUE(callee_problem.has_value());
  }
  /// As many bytes as the end has to say, or what is wrong.
  std::vector<std::byte> hear(Connection& end, size_t count) {
    std::vector<std::byte> heard, buffer(5000);
    bool waits = false;
    for (int tries = 0; tries < 4000 && heard.size() < count && read_problem.empty(); ++tries) {
      if (!waits) {
        waits = true;
        end.read_some(buffer, [&](size_t got, const std::string& problem) {
          waits = false;
          read_problem = problem;
          heard.insert(heard.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(got));
        });
      }
      context.run_one_for(5ms);
    }
    if (waits) end.close();
    return heard;
  }

  asio::io_context context;
  asio::executor_work_guard<asio::io_context::executor_type> work{context.get_executor()};
  std::shared_ptr<Tapped> tap;  ///< below the caller
  std::shared_ptr<Connection> plain_callee, caller, callee;
  std::optional<std::string> caller_problem, callee_problem;
  std::string read_problem;
};

TEST_F(Tls, both_ends_understand_each_other) {
  encrypt();
  shake_hands();
  EXPECT_EQ(caller_problem, "");
  EXPECT_EQ(callee_problem, "");
  tap->written.clear();
  const auto secret = bytes_of("what nobody else may read");
  EXPECT_EQ(caller->write(secret, 1s), "");
  const auto& sealed = tap->written;
  EXPECT_GT(sealed.size(), secret.size());
  EXPECT_EQ(std::search(sealed.begin(), sealed.end(), secret.begin(), secret.end()), sealed.end());
  EXPECT_EQ(hear(*callee, secret.size()), secret);
  const auto answer = bytes_of("understood");
  EXPECT_EQ(callee->write(answer, 1s), "");
  EXPECT_EQ(hear(*caller, answer.size()), answer);
  EXPECT_EQ(read_problem, "");
}

TEST_F(Tls, many_bytes_pass_while_the_reader_takes_them) {
  encrypt();
  shake_hands();
  const std::vector<std::byte> large(3'000'000, std::byte{7});
  std::vector<std::byte> heard, buffer(1 << 16);
  std::function<void()> read = [&] {
    callee->read_some(buffer, [&](size_t got, const std::string& problem) {
      EXPECT_EQ(problem, "");
      heard.insert(heard.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(got));
      if (heard.size() < large.size()) read();
    });
  };
  read();
  EXPECT_EQ(caller->write(large, 20s), "");
  for (int tries = 0; tries < 2000 && heard.size() < large.size(); ++tries) context.run_one_for(5ms);
  EXPECT_EQ(heard, large);
}

TEST_F(Tls, bytes_may_come_one_by_one) {
  encrypt();
  tap->piece = 1;
  shake_hands();
  EXPECT_EQ(callee->write(bytes_of("slowly"), 1s), "");
  EXPECT_EQ(hear(*caller, 6), bytes_of("slowly"));
}

TEST_F(Tls, another_key_ends_the_handshake) {
  encrypt(key_of(2));
  shake_hands();
  EXPECT_NE(callee_problem->find("is the key the same?"), std::string::npos) << *callee_problem;
  EXPECT_NE(callee->write(bytes_of("to a stranger"), 100ms), "");
}

TEST_F(Tls, a_changed_byte_is_noticed) {
  encrypt();
  shake_hands();
  tap->flips = true;
  EXPECT_EQ(caller->write(bytes_of("a message"), 1s), "");
  EXPECT_TRUE(hear(*callee, 9).empty());
  EXPECT_EQ(read_problem, "TLS: bytes that the peer did not encrypt");
}

TEST_F(Tls, what_is_no_handshake_is_refused) {
  encrypt();
  EXPECT_EQ(tap->write(bytes_of("GET / HTTP/1.1\r\n\r\n"), 1s), "");
  callee->open([this](const std::string& problem) { callee_problem = problem; });
  for (int tries = 0; tries < 1000 && !callee_problem; ++tries) context.run_for(5ms);
  ASSERT_TRUE(callee_problem.has_value());
  EXPECT_NE(callee_problem->find("TLS: the handshake failed"), std::string::npos) << *callee_problem;
}

TEST_F(Tls, nothing_is_said_before_the_handshake_is_over) {
  encrypt();
  EXPECT_EQ(caller->write(bytes_of("too early"), 100ms), "is not encrypted yet");
  EXPECT_TRUE(tap->written.empty());
}

TEST_F(Tls, a_peer_that_goes_is_told_as_without_encryption) {
  encrypt();
  shake_hands();
  caller->close();
  EXPECT_TRUE(hear(*callee, 1).empty());
  EXPECT_EQ(read_problem, closed_by_peer);
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
