// What can be read and written is known beforehand, and asking leaves nothing behind.
#include "base/file_access.hpp"

#include "base/error.hpp"
#include "base/file.hpp"

#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace triptych {
namespace {

namespace fs = std::filesystem;

/// Nobody in particular: the superuser may read and write everything.
class Nobody {
 public:
  Nobody() { [[maybe_unused]] const int result = ::seteuid(65534); }
  ~Nobody() { [[maybe_unused]] const int result = ::seteuid(::getuid()); }
};

class FileAccess : public testing::Test {
 protected:
  FileAccess()
      : folder(fs::path(testing::TempDir()) / ("triptych_file_access_" + std::to_string(::getpid()))) {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~FileAccess() override { fs::remove_all(folder); }

  /// What is said of the file, after its name; empty where nothing is wrong.
  std::string said(void (*check)(const fs::path&), const fs::path& file) const {
    try {
      check(file);
    } catch (const Error& error) {
      const std::string text = error.what(), start = file.string() + ": ";
      EXPECT_TRUE(text.starts_with(start)) << text;
      return text.substr(start.size());
    }
    return "";
  }
  void make_socket(const fs::path& file) const {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    file.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
    const int descriptor = ::socket(AF_UNIX, SOCK_STREAM, 0);
    ASSERT_EQ(::bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    ::close(descriptor);
  }

  fs::path folder;
};

TEST_F(FileAccess, what_is_no_file_is_called_what_it_is) {
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  make_socket(folder / "socket");
  fs::create_symlink("loop", folder / "loop");
  EXPECT_EQ(said(check_readable, folder), "is a folder, not a file");
  EXPECT_EQ(said(check_readable, folder / "pipe"), "is a pipe, not a file");
  EXPECT_EQ(said(check_readable, folder / "socket"), "is a socket, not a file");
  EXPECT_EQ(said(check_readable, "/dev/null"), "is a device, not a file");
  EXPECT_EQ(said(check_readable, folder / "none"), "cannot be opened: No such file or directory");
  EXPECT_EQ(said(check_readable, folder / "loop"), "cannot be opened: Too many levels of symbolic links");
  EXPECT_EQ(said(check_folder_there, folder / "none"), "cannot be opened: No such file or directory");
  EXPECT_EQ(said(check_folder_there, "/dev/null"), "is a device, not a folder");
  EXPECT_EQ(said(check_folder_there, folder), "");
}

TEST_F(FileAccess, whole_reads_refuse_what_is_no_file_and_do_not_wait_for_a_pipe) {
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const fs::path& file : {folder / "pipe", fs::path("/dev/zero")})
    EXPECT_THROW(read_text_file(file), Error) << file;
}

TEST_F(FileAccess, permissions_count_and_nothing_is_left_of_the_question) {
  write_file(folder / "file", "text");
  fs::permissions(folder / "file", fs::perms::none);
  fs::create_directory(folder / "sealed", folder);
  fs::permissions(folder / "sealed", fs::perms(0555));
  fs::create_directory(folder / "open");
  fs::permissions(folder / "open", fs::perms::all);
  {
    const Nobody nobody;
    EXPECT_EQ(said(check_readable, folder / "file"), "cannot be opened: Permission denied");
    EXPECT_EQ(said(check_writable, folder / "sealed" / "new"), "cannot be written: Permission denied");
    EXPECT_EQ(said(check_folder_writable, folder / "sealed"), "cannot be written: Permission denied");
    EXPECT_EQ(said(check_folder_writable, folder / "sealed" / "below" / "it"),
              "cannot be written: Permission denied");
    EXPECT_EQ(said(check_writable, folder / "open" / "new"), "");
    EXPECT_EQ(said(check_folder_writable, folder / "open"), "");
    EXPECT_EQ(said(check_folder_writable, folder / "open" / "below" / "it"), "");
  }
  EXPECT_TRUE(fs::is_empty(folder / "open"));
  EXPECT_TRUE(fs::is_empty(folder / "sealed"));
}

TEST_F(FileAccess, a_place_that_cannot_be_made_is_known) {
  write_file(folder / "file", "text");
  fs::create_symlink("nowhere", folder / "dangling");
  EXPECT_EQ(said(check_writable, folder / "none" / "new"), "cannot be written: No such file or directory");
  EXPECT_EQ(said(check_writable, folder), "is a folder, not a file");
  EXPECT_EQ(said(check_writable, folder / std::string(300, 'x')), "cannot be written: File name too long");
  EXPECT_EQ(said(check_folder_writable, folder / "file"), "is a file, not a folder");
  EXPECT_EQ(said(check_folder_writable, folder / "file" / "below"),
            (folder / "file").string() + " is a file, not a folder");
  EXPECT_EQ(said(check_folder_writable, folder / "dangling"), "is a link to nothing, not a folder");
  EXPECT_EQ(said(check_folder_writable, folder / std::string(300, 'x')),
            "cannot be made: File name too long");
  EXPECT_EQ(said(check_writable, folder / "file"), "") << "it is replaced";
  EXPECT_EQ(read_text_file(folder / "file"), "text");
}

}  // namespace
}  // namespace triptych
