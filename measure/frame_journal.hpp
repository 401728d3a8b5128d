// Frame records in a file while they come, so that none is lost with the process that writes them.
#pragma once

#include "base/descriptor.hpp"
#include "nodes/frame_record.hpp"

#include <filesystem>
#include <vector>

namespace triptych {

/// Appends records to a file, a JSON line each, in one write each.
class FrameJournal {
 public:
  /// Error (place: the path) if it cannot be written.
  explicit FrameJournal(const std::filesystem::path& path);
  void add(const FrameRecord& record);

 private:
  std::filesystem::path path_;
  Descriptor file_;
};

/// Cuts off what a killed writer left half written. How many whole records there are; 0 without a file.
size_t mend_frame_journal(const std::filesystem::path& path);

/// All records; none without a file. Error (path, line) for what is none.
std::vector<FrameRecord> read_frame_journal(const std::filesystem::path& path);

}  // namespace triptych
