// Folders that several runs may write into, one after the other: nothing of one is mixed with another's.
#pragma once

#include "base/descriptor.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace triptych {

/// A folder that this run writes numbered pictures into, while it lives. A hidden file, the mark, names the
/// command and its pictures. Those of an earlier run of the same command are written over, and what a run
/// that ended well did not write again is removed. All other pictures with such names, of other runs or the
/// user's own, are moved into a folder `earlier-N` within it at once, and that is said.
class OutputFolder {
 public:
  /// Makes the folder. `command` tells runs apart: command_line() without what only this run is about. Error
  /// (folder) where it cannot be made, where a run that does not end within seconds writes into it, or where
  /// the mark's name belongs to something else.
  OutputFolder(std::filesystem::path folder, const std::string& command);
  /// Removes the folder, if it was made for a run that then put nothing into it.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// All pictures were made: what is left of the command's earlier ones is removed.
  void finish();
  /// The folder stays claimed until the processes have ended, too, that this one starts from now on.
  void share_with_children() const;

 private:
  /// Size and time of change, by name.
  using Pictures = std::map<std::string, std::string>;

  void lock() const;
  Pictures read_mark();
  void write_mark(const Pictures& pictures) const;
  Pictures pictures() const;
  void move_aside(const Pictures& strangers) const;
  /// Those of the pictures that the mark knew and that are still the same.
  Pictures left_of_earlier() const;

  std::filesystem::path folder_;
  std::string command_;
  bool made_ = false;
  Descriptor mark_;   ///< locked
  Pictures earlier_;  ///< of the same command
};

}  // namespace triptych
