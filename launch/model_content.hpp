// What decides what a pack is: the content of the models' files, the flags and the program.
#pragma once

#include "base/content_key.hpp"
#include "launch/build_flags.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace triptych {

/// The programs that read further formats, beside this one, by their content.
ContentKey key_of_readers();

/// The files of models, named as they lie from the folder of the first one: models that were moved together
/// are the same.
class ModelContent {
 public:
  /// Reads all files that the models name. Error for one that cannot be read.
  explicit ModelContent(const BuildFlags& flags);

  /// In words: every flag that changes the pack, the program with its readers of further formats, and a
  /// checksum of each file.
  const std::string& key() const { return key_; }
  /// The same after the files were read again.
  std::string key_now() const;

  /// A file's name as it lies from the folder of the first model, of printable letters, and back.
  std::string name_of(const std::filesystem::path& file) const;
  std::filesystem::path file_of(const std::string& name) const;

  /// Of all files that an import read (Model::files) those that the models do not name, with their content:
  /// a reader opened them.
  using Files = std::map<std::string, std::string>;
  Files opened(const std::vector<std::string>& read) const;
  /// Whether they still have that content.
  bool still_holds(const Files& opened) const;

 private:
  BuildFlags flags_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
  std::string key_;
};

}  // namespace triptych
