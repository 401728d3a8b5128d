#include "launch/recorded_pack.hpp"

#include "base/error.hpp"
#include "protocol/http_source.hpp"
#include "session/open_pack.hpp"

namespace triptych {

Pack open_recorded_pack(const std::filesystem::path& recording, const RecordingHeader& header,
                        const std::filesystem::path& moved_to) {
  if (moved_to.empty() && !is_web_address(header.pack) && !std::filesystem::exists(header.pack)) {
    fail(recording.string(), "was recorded with {}, which is not there: --pack says where it is now",
         header.pack);
  }
  Pack pack = open_pack(moved_to.empty() ? std::filesystem::path(header.pack) : moved_to);
  if (pack.content_hash() != header.own.pack_hash) {
    fail(recording.string(), "was recorded with another pack: its hash is {:016x}, this one's {:016x}",
         header.own.pack_hash, pack.content_hash());
  }
  return pack;
}

}  // namespace triptych
