#include "samples/surfaces/ply_writer.hpp"

#include "base/error.hpp"

#include <bit>
#include <cerrno>
#include <cstring>
#include <limits>
#include <unistd.h>
#include <vector>

namespace triptych {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY bytes are written as they lie in memory");

#pragma pack(push, 1)
struct FaceRecord {
  uint8_t count = 3;
  std::array<uint32_t, 3> vertices{};
};
#pragma pack(pop)
static_assert(sizeof(FaceRecord) == 13);

constexpr size_t block_bytes = size_t{1} << 20;

/// A file without a name: it is gone when it is closed, or when the process ends, however that happens.
std::FILE* nameless_file(const std::filesystem::path& beside) {
  const std::string name = beside.string() + ".faces-" + std::to_string(::getpid());
  std::FILE* file = std::fopen(name.c_str(), "wb+");
  if (!file) fail(name, "cannot be written: {}", std::strerror(errno));
  ::unlink(name.c_str());
  return file;
}

}  // namespace

PlyWriter::PlyWriter(const std::filesystem::path& path, const std::string& comment)
    : place_(path.string()), comment_(comment), file_(path), spool_(nameless_file(path)) {
  file_.write(header());
}

PlyWriter::~PlyWriter() { std::fclose(spool_); }

/// Of one length, whatever the counts: a comment fills up.
std::string PlyWriter::header() const {
  const auto count = [](const char* element, uint64_t number) {
    constexpr size_t digits = 10;
    const std::string text = std::to_string(number);
    return fmt::format("comment {}\nelement {} {}\n", std::string(digits - text.size(), '.'), element, text);
  };
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}\n"
      "{}property float x\nproperty float y\nproperty float z\n"
      "{}property list uchar int vertex_indices\nend_header\n",
      comment_, count("vertex", vertices_), count("face", faces_));
}

void PlyWriter::spool_failed() const { fail(place_, "faces cannot be kept: {}", std::strerror(errno)); }

void PlyWriter::add_vertices(std::span<const glm::vec3> positions) {
  vertices_ += positions.size();
  if (vertices_ > uint64_t{std::numeric_limits<int32_t>::max()})
    fail(place_, "more vertices than 31 bits can number");
  file_.write(std::as_bytes(positions));
}

void PlyWriter::add_faces(std::span<const std::array<uint32_t, 3>> faces) {
  std::vector<FaceRecord> records(std::min(faces.size(), block_bytes / sizeof(FaceRecord)));
  while (!faces.empty()) {
    const size_t count = std::min(faces.size(), records.size());
    for (size_t i = 0; i < count; ++i) records[i].vertices = faces[i];
    if (std::fwrite(records.data(), sizeof(FaceRecord), count, spool_) != count) spool_failed();
    faces_ += count;
    faces = faces.subspan(count);
  }
}

void PlyWriter::finish() {
  if (std::fflush(spool_) != 0 || std::fseek(spool_, 0, SEEK_SET) != 0) spool_failed();
  std::vector<std::byte> block(block_bytes);
  for (size_t count; (count = std::fread(block.data(), 1, block.size(), spool_)) > 0;)
    file_.write(std::span(block).first(count));
  if (std::ferror(spool_)) spool_failed();
  file_.write_at(0, std::as_bytes(std::span<const char>(header())));
  file_.commit();
}

}  // namespace triptych
