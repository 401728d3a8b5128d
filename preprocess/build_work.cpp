#include "preprocess/build_work.hpp"

#include <array>

namespace triptych {

namespace {

/// The files that batches write; the last one belongs to the pack.
constexpr std::array file_names = {"parts", "surfaces", "pack", "pack.pieces"};

/// A record of the journal.
struct StoredBatch {
  UnitKind kind{};
  std::vector<StoredUnit> units;
};

}  // namespace

template <>
inline constexpr auto record_members<StoredBatch> = std::tuple(&StoredBatch::kind, &StoredBatch::units);

BuildWork::BuildWork(const std::filesystem::path& pack, const std::string& fingerprint)
    : folder_(pack, fingerprint, file_names),
      journal_(folder_),
      left_to_replay_(journal_.replayable()),
      parts_(folder_.file(file_names[0]), kept(0)),
      surfaces_(folder_.file(file_names[1]), kept(1)),
      pack_(pack, folder_.file(file_names[2]), {kept(2), kept(3)}) {}

SpoolFile& BuildWork::geometry(UnitKind kind) {
  const bool coarse =
      kind == UnitKind::part_levels || kind == UnitKind::hlod || kind == UnitKind::root_geometry;
  return coarse ? surfaces_ : parts_;
}

StoredUnit BuildWork::store(UnitKind kind, UnitResult result) {
  StoredUnit unit;
  unit.first_chunk = static_cast<uint32_t>(pack_.chunks().size());
  for (const UnitChunk& added : result.chunks) {
    unit.chunks.push_back(pack_.chunks()[pack_.add_chunk(added.chunk, added.lattice)]);
    unit.seen_from_outside.push_back(added.chunk.seen_from_outside);
    unit.normals.add(added.chunk.normals);
  }
  for (const std::vector<std::byte>& record : result.geometry)
    unit.geometry.push_back(geometry(kind).append(record));
  unit.figures = std::move(result.figures);
  return unit;
}

void BuildWork::run(UnitKind kind, std::span<const uint32_t> indices, const UnitFunction& unit,
                    const Take& take, Progress* progress) {
  const std::string place = folder_.file("journal").string();
  StoredBatch batch{kind, {}};
  if (const auto record = journal_.replay()) {
    --left_to_replay_;
    batch = record_of<StoredBatch>(*record, place);
    if (batch.kind != kind || batch.units.size() != indices.size())
      fail(place, "holds other work than this build's: remove the folder, and build again");
    for (const StoredUnit& stored : batch.units)
      pack_.adopt(stored.chunks, stored.seen_from_outside, stored.normals);
    if (progress) progress->advance(indices.size());
  } else {
    for (std::vector<std::byte>& bytes : run_units(indices, unit, progress)) {
      batch.units.push_back(store(kind, record_of<UnitResult>(bytes, "a build unit")));
      bytes = {};
    }
    const PackWriter::Kept kept = pack_.flush();
    journal_.append(record_bytes(batch), std::array{parts_.kept(), surfaces_.kept(), kept.pack, kept.pieces});
  }
  for (size_t i = 0; i < indices.size(); ++i) take(indices[i], batch.units[i]);
}

}  // namespace triptych
