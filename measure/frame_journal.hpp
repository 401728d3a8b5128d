// Frame records that are written to a file one by one, so that none is lost if the process ends.
#pragma once

#include "base/descriptor.hpp"
#include "nodes/frame_record.hpp"

#include <filesystem>
#include <vector>

namespace triptych {

/// Appends records to a file, each as one line of JSON by one write.
class FrameJournal {
 public:
  /// Error (place: the path) if it cannot be written.
  explicit FrameJournal(const std::filesystem::path& path);
  void add(const FrameRecord& record);

 private:
  std::filesystem::path path_;
  Descriptor file_;
};

/// Removes a record that a killed writer left incomplete. Returns how many complete records there are; 0
/// without a file.
size_t mend_frame_journal(const std::filesystem::path& path);

/// All records; none without a file. Error (path, line) for a line that is not a record.
std::vector<FrameRecord> read_frame_journal(const std::filesystem::path& path);

}  // namespace triptych
