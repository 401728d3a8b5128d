#include "model/import/byte_spool.hpp"

#include "base/unnamed_file.hpp"

namespace triptych {

namespace {
constexpr size_t block_bytes = size_t{1} << 20;
}

void ByteSpool::append(std::span<const std::byte> bytes) {
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  if (file_.is_open() && buffer_.size() >= block_bytes) flush();
}

void ByteSpool::move_to_file(const std::filesystem::path& folder) {
  name_ = folder.empty() ? "the folder for temporary files" : folder.string();
  file_ = open_unnamed_file(folder);
  flush();
}

void ByteSpool::flush() {
  write_all(file_.number(), buffer_, name_ + ": a temporary file");
  written_ += buffer_.size();
  buffer_.clear();
  if (buffer_.capacity() > 4 * block_bytes) buffer_.shrink_to_fit();
}

std::shared_ptr<const StreamSource> ByteSpool::take_file(const std::string& name) {
  flush();
  return std::make_shared<StreamSource>(name, std::move(file_));
}

void UnpackedBytes::append(std::span<const std::byte> bytes) {
  spool_.append(bytes);
  if (!spool_.file_.is_open() && spool_.size() > max_in_memory) spool_.move_to_file(folder_);
}

std::shared_ptr<const StreamSource> UnpackedBytes::take() {
  if (spool_.file_.is_open()) return spool_.take_file(name_);
  return std::make_shared<StreamSource>(name_, std::move(spool_.buffer_));
}

}  // namespace triptych
