// A build's files together with its journal: each unit is processed once, even if the build is killed in
// between.
#pragma once

#include "preprocess/build_unit.hpp"
#include "preprocess/pack_writer.hpp"
#include "preprocess/work_folder.hpp"

#include <functional>

namespace triptych {

/// The end of the group of items that begins with `first`: as many as fit into `most` together, and at least
/// one.
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

/// A unit's result, numbered and stored.
struct StoredUnit {
  uint32_t first_chunk = 0;       ///< index in the pack of the first of its chunks; the others follow
  std::vector<ChunkInfo> chunks;  ///< as in the pack
  std::vector<uint8_t> seen_from_outside;  ///< 1 for each of them that is made to be
  NormalsUsed normals;                     ///< of them
  std::vector<SpoolPlace> geometry;  ///< where each of its records lies, in BuildWork::geometry() of its kind
  std::vector<std::byte> figures;    ///< as the unit returned them

  template <typename Figures>
  Figures figures_as() const {
    return record_of<Figures>(figures, "the figures of a build unit");
  }
};
template <>
inline constexpr auto record_members<StoredUnit> = std::tuple(&StoredUnit::first_chunk, &StoredUnit::chunks,
                                                              &StoredUnit::seen_from_outside,
                                                              &StoredUnit::normals, &StoredUnit::geometry,
                                                              &StoredUnit::figures);

class BuildWork {
 public:
  using Take = std::function<void(uint32_t index, const StoredUnit&)>;

  /// See WorkFolder.
  BuildWork(const std::filesystem::path& pack, const std::string& fingerprint);

  /// Runs the units of a kind with these ascending indices, stores their results and passes them to `take`,
  /// both in that order; if an earlier run did this batch, passes on the results of that run. The batch is
  /// one record of the journal: batches come in the same order in every run.
  void run(UnitKind kind, std::span<const uint32_t> indices, const UnitFunction& unit, const Take& take,
           Progress* progress = nullptr);
  /// How many of the next batches an earlier run has done.
  uint64_t left_to_replay() const { return left_to_replay_; }

  /// The geometry of units of this kind: parts of meshes, or what HLODs begin with.
  SpoolFile& geometry(UnitKind kind);
  SpoolFile& parts() { return geometry(UnitKind::divided_mesh); }
  SpoolFile& surfaces() { return geometry(UnitKind::hlod); }
  PackWriter& pack() { return pack_; }
  std::filesystem::path file(const std::string& name) const { return folder_.file(name); }

 private:
  KeptBytes kept(size_t file) const {
    return journal_.kept().empty() ? KeptBytes() : journal_.kept().at(file);
  }
  StoredUnit store(UnitKind kind, UnitResult result);

  WorkFolder folder_;
  BuildJournal journal_;
  uint64_t left_to_replay_;
  SpoolFile parts_, surfaces_;
  PackWriter pack_;
};

}  // namespace triptych
