#include "session/picture_writer.hpp"

#include "base/notice.hpp"
#include "base/thread_name.hpp"
#include "render/png_file.hpp"

namespace triptych {

PictureWriter::PictureWriter(OnFailure on_failure) : on_failure_(on_failure), thread_([this] { work(); }) {}

PictureWriter::~PictureWriter() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PictureWriter::rethrow() {
  if (failure_) std::rethrow_exception(failure_);
}

void PictureWriter::add(std::filesystem::path file, int width, int height, std::vector<uint8_t> rgba,
                        std::function<void()> written) {
  constexpr size_t max_queued = 8;
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return queue_.size() < max_queued || failure_; });
  rethrow();
  queue_.push_back({std::move(file), width, height, std::move(rgba), std::move(written)});
  changed_.notify_all();
}

void PictureWriter::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return (queue_.empty() && !busy_) || failure_; });
  rethrow();
}

void PictureWriter::write(const Picture& picture) const {
  try {
    write_png(picture.file, picture.width, picture.height, picture.rgba);
  } catch (const std::exception& error) {
    if (on_failure_ == OnFailure::stop) throw;
    notice_once(fmt::format("{}; the walk goes on without that picture", error.what()));
  }
  if (picture.written) picture.written();
}

void PictureWriter::work() {
  name_thread("write-pictures");
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return !queue_.empty() || ending_; });
    if (queue_.empty()) return;
    const Picture picture = std::move(queue_.front());
    queue_.pop_front();
    busy_ = true;
    lock.unlock();
    std::exception_ptr failure;
    try {
      write(picture);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    busy_ = false;
    if (failure && !failure_) failure_ = failure;
    changed_.notify_all();
  }
}

}  // namespace triptych
