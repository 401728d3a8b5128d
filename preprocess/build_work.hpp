// A build's files and its journal together: work in units that are done once, whoever is killed in between.
#pragma once

#include "base/bytes.hpp"
#include "preprocess/pack_writer.hpp"
#include "preprocess/work_folder.hpp"

#include <functional>

namespace triptych {

/// The end of the group of items that begins with `first`: as many of them as come to `most` together, and
/// one at least.
template <typename SizeOf>
size_t end_of_group(size_t first, size_t count, uint64_t most, const SizeOf& size_of) {
  uint64_t sum = 0;
  size_t end = first;
  for (; end < count; ++end) {
    sum += size_of(end);
    if (end > first && sum > most) break;
  }
  return end;
}

class BuildWork {
 public:
  /// See WorkFolder.
  BuildWork(const std::filesystem::path& pack, const std::string& fingerprint);

  /// Does the work, whose record says what came of it, and has the record taken; or, if an earlier run did
  /// it, has that run's record taken. Units come in the same order in every run.
  void unit(const std::function<void(ByteWriter&)>& work, const std::function<void(ByteReader&)>& take);
  /// How many of the next units an earlier run did.
  uint64_t left_to_replay() const { return left_to_replay_; }

  SpoolFile& parts() { return parts_; }        ///< parts of meshes, as they were divided
  SpoolFile& surfaces() { return surfaces_; }  ///< geometry that HLODs begin with
  PackWriter& pack() { return pack_; }
  std::filesystem::path file(const std::string& name) const { return folder_.file(name); }

 private:
  KeptBytes kept(size_t file) const {
    return journal_.kept().empty() ? KeptBytes() : journal_.kept().at(file);
  }

  WorkFolder folder_;
  BuildJournal journal_;
  uint64_t left_to_replay_;
  SpoolFile parts_, surfaces_;
  PackWriter pack_;
};

}  // namespace triptych
