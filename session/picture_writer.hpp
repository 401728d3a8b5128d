// Writes PNG files on a thread of its own, while the next frames are drawn.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace triptych {

/// A bounded queue: add() waits where the disk is slower than the frames.
class PictureWriter {
 public:
  enum class OnFailure {
    stop,
    say,  ///< on standard error, and go on with the next picture
  };
  explicit PictureWriter(OnFailure on_failure = OnFailure::stop);
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// rgba: width × height × 4 bytes, bottom row first. Throws what an earlier picture failed with.
  /// written: called, in the other thread and in the order of adding, once the file is there, or was said not
  /// to be.
  void add(std::filesystem::path file, int width, int height, std::vector<uint8_t> rgba,
           std::function<void()> written = {});
  /// Waits until every picture is written; throws what failed.
  void finish();

 private:
  struct Picture {
    std::filesystem::path file;
    int width, height;
    std::vector<uint8_t> rgba;
    std::function<void()> written;
  };
  void work();
  void write(const Picture& picture) const;
  void rethrow();

  OnFailure on_failure_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Picture> queue_;
  bool busy_ = false, ending_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace triptych
