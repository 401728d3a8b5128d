// Folders that several runs may write into, one after the other: nothing of one is mixed with another's.
#pragma once

#include "base/descriptor.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace triptych {

/// A folder that this run writes numbered pictures into, while it lives. Those of an earlier run of the same
/// command are written over, and those that this run did not write again are removed at its end; those of any
/// other run are moved into a folder `earlier-N` within it at once, and that is said. A hidden file names the
/// command.
class OutputFolder {
 public:
  /// Makes the folder. `command` tells runs apart: command_line() without what only this run is about. Error
  /// (folder) where it cannot be made, or where a run that has not ended writes into it.
  OutputFolder(std::filesystem::path folder, const std::string& command);
  /// Removes what the run has left of the command's earlier pictures, if it wrote any; and the folder, if it
  /// was made for a run that then put nothing into it.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::string claim(const std::string& command);
  std::vector<std::filesystem::path> pictures() const;
  void move_aside(const std::vector<std::filesystem::path>& old) const;

  std::filesystem::path folder_;
  bool made_ = false;
  Descriptor mark_;  ///< locked
  std::map<std::filesystem::path, std::filesystem::file_time_type>
      old_;  ///< of the same command, when they were written
};

}  // namespace triptych
