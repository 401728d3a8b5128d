#include "protocol/recording.hpp"

#include "base/file.hpp"
#include "tests/protocol/sample_messages.hpp"

#include <fstream>
#include <gtest/gtest.h>

namespace triptych {
namespace {

class Recording : public testing::Test {
 protected:
  Recording() {
    header.own.role = Role::switch_0;
    header.own.pack_hash = 0x1234567890abcdef;
    header.own.device.renderer = "a renderer";
    header.pack = "models/building.tpk";
    for (const Message& message : sample_messages()) {
      messages.push_back({.time_ms = 1.5 * static_cast<double>(messages.size()),
                          .sent = messages.size() % 2 == 0,
                          .peer = Role::render,
                          .channel = Channel::nodes,
                          .message = message});
    }
  }
  ~Recording() override { std::filesystem::remove(file); }

  void write() const {
    RecordingWriter writer(file, header);
    for (const RecordedMessage& message : messages) writer.add(message);
  }
  std::vector<RecordedMessage> read() const {
    RecordingReader reader(file);
    std::vector<RecordedMessage> found;
    while (auto message = reader.next()) found.push_back(std::move(*message));
    return found;
  }
  std::string bytes() const { return read_text_file(file); }
  void replace(const std::string& content) const { std::ofstream(file, std::ios::binary) << content; }

  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) /
      ("triptych_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
       ".recording");
  RecordingHeader header;
  std::vector<RecordedMessage> messages;
};

TEST_F(Recording, reads_as_it_was_written) {
  write();
  EXPECT_EQ(RecordingReader(file).header(), header);
  EXPECT_EQ(read(), messages);
}

TEST_F(Recording, ends_again_and_again_once_it_has_ended) {
  messages.clear();
  write();
  RecordingReader reader(file);
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.next());
}

TEST_F(Recording, of_a_role_that_was_killed_is_cut_and_holds_what_was_before) {
  write();
  const std::string whole = bytes();
  const size_t end = 16;
  replace(whole.substr(0, whole.size() - end));
  RecordingReader reader(file);
  for (const RecordedMessage& message : messages) EXPECT_EQ(reader.next(), message);
  EXPECT_THROW(reader.next(), RecordingCut);
}

TEST_F(Recording, notices_wherever_it_is_cut) {
  write();
  const std::string whole = bytes();
  for (size_t size = 0; size < whole.size(); ++size) {
    replace(whole.substr(0, size));
    EXPECT_THROW(read(), Error) << size << " of " << whole.size() << " bytes";
  }
}

TEST_F(Recording, notices_each_byte_that_was_changed) {
  write();
  const std::string whole = bytes();
  for (size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x20);
    replace(damaged);
    EXPECT_THROW(read(), Error) << "byte " << i;
  }
}

TEST_F(Recording, that_was_finished_is_damaged_and_not_cut_whichever_bit_was_changed) {
  write();
  const std::string whole = bytes();
  for (size_t bit = 0; bit < 8 * whole.size() - 8 * 16;
       ++bit) {  // the last 16 bytes say that it was finished
    std::string damaged = whole;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ 1 << bit % 8);
    replace(damaged);
    try {
      read();
      ADD_FAILURE() << "bit " << bit << " is not noticed";
    } catch (const RecordingCut& error) {
      ADD_FAILURE() << "bit " << bit << ": " << error.what();
    } catch (const Error&) {
    }
  }
}

TEST_F(Recording, says_where_the_damage_is) {
  write();
  std::string damaged = bytes();
  damaged[damaged.size() / 2] ^= 1;
  replace(damaged);
  try {
    read();
    FAIL() << "nothing was noticed";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(file.string() + " byte "), std::string::npos) << error.what();
  }
}

TEST_F(Recording, of_another_version_names_both) {
  write();
  std::string other = bytes();
  other[8] = 9;
  replace(other);
  try {
    read();
    FAIL() << "nothing was noticed";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("version 9"), std::string::npos) << error.what();
  }
}

TEST_F(Recording, that_does_not_exist_or_is_something_else_is_an_error) {
  EXPECT_THROW(RecordingReader{file}, Error);
  replace("a text that is long enough to be a start");
  EXPECT_THROW(RecordingReader{file}, Error);
}

}  // namespace
}  // namespace triptych
