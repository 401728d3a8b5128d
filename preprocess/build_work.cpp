#include "preprocess/build_work.hpp"

#include <array>

namespace triptych {

namespace {
/// What units write; the last one belongs to the pack.
constexpr std::array file_names = {"parts", "surfaces", "pack", "pack.pieces"};
}  // namespace

BuildWork::BuildWork(const std::filesystem::path& pack, const std::string& fingerprint)
    : folder_(pack, fingerprint, file_names),
      journal_(folder_),
      left_to_replay_(journal_.replayable()),
      parts_(folder_.file(file_names[0]), kept(0)),
      surfaces_(folder_.file(file_names[1]), kept(1)),
      pack_(pack, folder_.file(file_names[2]), {kept(2), kept(3)}) {}

void BuildWork::unit(const std::function<void(ByteWriter&)>& work,
                     const std::function<void(ByteReader&)>& take) {
  const std::string place = folder_.file("journal").string();
  if (const auto record = journal_.replay()) {
    --left_to_replay_;
    ByteReader reader(*record, place);
    pack_.adopt(reader.read_all<ChunkInfo>(reader.read<uint64_t>()));
    take(reader);
    reader.expect_end();
    return;
  }
  const size_t first_chunk = pack_.chunks().size();
  ByteWriter result;
  work(result);
  const auto chunks = std::span(pack_.chunks()).subspan(first_chunk);
  ByteWriter record;
  record.write(uint64_t{chunks.size()});
  record.write_all(chunks);
  record.write_all(std::span<const std::byte>(result.bytes()));
  const PackWriter::Kept kept = pack_.flush();
  journal_.append(record.bytes(), std::array{parts_.kept(), surfaces_.kept(), kept.pack, kept.pieces});
  ByteReader reader(result.bytes(), place);
  take(reader);
  reader.expect_end();
}

}  // namespace triptych
