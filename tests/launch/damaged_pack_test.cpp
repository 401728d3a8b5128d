// Packs that were cut, changed or put together from two: every command that reads one ends with one line.
#include "tests/session/scene_files.hpp"

#include <array>
#include <cstring>
#include <map>

namespace triptych {
namespace {

uint64_t number_at(const std::string& bytes, size_t offset) {
  uint64_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof(value));
  return value;
}

/// Damages by name.
std::map<std::string, std::string> damaged(const std::string& one, const std::string& other) {
  const size_t table = number_at(one, 16), skeleton = number_at(one, table + 32 + 8);
  const auto flipped = [&](size_t at) {
    std::string bytes = one;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    return bytes;
  };
  const size_t other_table = number_at(other, 16), other_skeleton = number_at(other, other_table + 32 + 8);
  return {{"cut in its header", one.substr(0, 20)},
          {"cut in its geometry", one.substr(0, skeleton / 2)},
          {"cut in its skeleton", one.substr(0, (skeleton + table) / 2)},
          {"cut in its table", one.substr(0, one.size() - 1)},
          {"flipped in its header", flipped(9)},
          {"flipped in its first chunk", flipped(40)},
          {"flipped in its last chunk", flipped(skeleton - 3)},
          {"flipped in its skeleton", flipped(skeleton + 99)},
          {"flipped in its table", flipped(table + 17)},
          {"with the other's geometry",
           other.substr(0, other_skeleton) + one.substr(std::min(one.size(), other_skeleton))},
          {"with the other's end", one.substr(0, skeleton) + other.substr(other_skeleton)},
          {"with the other's header", other.substr(0, 32) + one.substr(32)},
          {"with a page of zeros", one.substr(0, 512) + std::string(512, '\0') + one.substr(1024)},
          {"with two pages exchanged",
           one.substr(0, 512) + one.substr(1024, 512) + one.substr(512, 512) + one.substr(1536)}};
}

using DamagedPack = test::SceneFiles;

TEST_F(DamagedPack, ends_check_and_render_with_one_line_each) {
  scenes::write_pack("coplanar", folder.file("other.tpk"));
  const std::array<std::string, 2> packs = {test::text_of(pack), test::text_of(folder.file("other.tpk"))};
  ASSERT_GT(number_at(packs[0], 16), 4096u);
  const std::string file = folder.file("damaged.tpk");
  for (const auto& [name, bytes] : damaged(packs[0], packs[1])) {
    std::ofstream(file, std::ios::binary) << bytes;
    const std::string complaint = test::failure({"check", file});
    EXPECT_NE(complaint.find(file), std::string::npos) << name;
    if (name.find("header") == std::string::npos && name.find("cut") == std::string::npos) {
      EXPECT_NE(complaint.find("section "), std::string::npos) << name << ": " << complaint;
      EXPECT_NE(complaint.find("byte "), std::string::npos) << name << ": " << complaint;
    }
  }
  // A chunk that is damaged is no smaller picture: the first frame that needs it is the end.
  std::string all = packs[0];
  for (size_t at = 40; at < number_at(all, number_at(all, 16) + 32 + 8); at += 64)
    all[at] = static_cast<char>(all[at] ^ 0x10);
  std::ofstream(file, std::ios::binary) << all;
  const std::string complaint =
      test::failure({"render", file, "--path", path, "-o", folder.file("pictures")});
  EXPECT_NE(complaint.find("section GEOM: chunk"), std::string::npos) << complaint;
  test::run({"check", pack});
}

}  // namespace
}  // namespace triptych
