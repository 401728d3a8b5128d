#include "lod/preprocess/build_work.hpp"

#include <array>

namespace triptych {

BuildWork::BuildWork(const std::filesystem::path& pack, const std::string& fingerprint)
    : folder_(pack, fingerprint),
      journal_(folder_),
      left_to_replay_(journal_.replayable()),
      parts_(folder_.file("parts"), kept(0)),
      surfaces_(folder_.file("surfaces"), kept(1)),
      pack_(pack, folder_.file("pack"), kept(2)) {}

void BuildWork::unit(const std::function<void(ByteWriter&)>& work,
                     const std::function<void(ByteReader&)>& take) {
  const std::string place = folder_.file("journal").string();
  if (const auto record = journal_.replay()) {
    --left_to_replay_;
    ByteReader reader(*record, place);
    const auto chunks = reader.read_all<ChunkInfo>(reader.read<uint64_t>());
    pack_.adopt(chunks, reader.read_all<LatticeBox>(reader.read<uint64_t>()));
    take(reader);
    reader.expect_end();
    return;
  }
  const size_t first_chunk = pack_.chunks().size(), first_piece = pack_.pieces().size();
  ByteWriter result;
  work(result);
  const auto chunks = std::span(pack_.chunks()).subspan(first_chunk);
  const auto pieces = std::span(pack_.pieces()).subspan(first_piece);
  ByteWriter record;
  record.write(uint64_t{chunks.size()});
  record.write_all(chunks);
  record.write(uint64_t{pieces.size()});
  record.write_all(pieces);
  record.write_all(std::span<const std::byte>(result.bytes()));
  journal_.append(record.bytes(), std::array{parts_.size(), surfaces_.size(), pack_.flush()});
  ByteReader reader(result.bytes(), place);
  take(reader);
  reader.expect_end();
}

}  // namespace triptych
