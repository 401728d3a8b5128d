#include "measure/frame_journal.hpp"

#include "base/error.hpp"
#include "base/parse_json.hpp"
#include "measure/session_records.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>

namespace triptych {

FrameJournal::FrameJournal(const std::filesystem::path& path)
    : path_(path), file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644)) {
  if (!file_.is_open()) fail(path.string(), "cannot be written: {}", std::strerror(errno));
}

void FrameJournal::add(const FrameRecord& record) {
  const std::string line = to_json(record).dump() + "\n";
  write_all(file_.number(), std::as_bytes(std::span(line)), path_.string());
}

size_t mend_frame_journal(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  size_t lines = 0;
  uint64_t whole = 0, read = 0;
  std::vector<char> buffer(1 << 16);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())), in.gcount() > 0) {
    for (std::streamsize i = 0; i < in.gcount(); ++i) {
      ++read;
      if (buffer[static_cast<size_t>(i)] != '\n') continue;
      ++lines;
      whole = read;
    }
  }
  if (whole < read) std::filesystem::resize_file(path, whole);
  return lines;
}

std::vector<FrameRecord> read_frame_journal(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<FrameRecord> records;
  for (std::string line; std::getline(in, line);) {
    const std::string place = fmt::format("{}: line {}", path.string(), records.size() + 1);
    records.push_back(frame_record_from_json(parse_json(line, place), place));
  }
  return records;
}

}  // namespace triptych
