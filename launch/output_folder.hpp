// Folders that several runs may write into, one after the other: nothing of one is mixed with another's.
#pragma once

#include "base/descriptor.hpp"

#include <cstdint>
#include <filesystem>
#include <string>

namespace triptych {

/// What a run writes into a folder.
enum class Written : uint8_t {
  pictures,    ///< "000017.png" (session/pictures.hpp)
  recordings,  ///< "render.recording"
  both
};

/// A folder that this run writes numbered pictures or recordings into, while it lives. What an earlier run of
/// the same command left there is removed, since it is made anew; what any other run left is moved into a
/// folder `earlier-N` within it, and that is said. A hidden file names the command.
class OutputFolder {
 public:
  /// Makes the folder. `command` tells runs apart: command_line() without what only this run is about. Error
  /// (folder) where it cannot be made, or where a run that has not ended writes into it.
  OutputFolder(std::filesystem::path folder, Written written, const std::string& command);
  /// Removes the folder if it was made for a run that then put nothing into it.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::string claim(const std::string& command);
  void clear(Written written, bool same_command) const;

  std::filesystem::path folder_;
  bool made_ = false;
  Descriptor mark_;  ///< locked
};

}  // namespace triptych
