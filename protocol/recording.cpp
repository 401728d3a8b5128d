#include "protocol/recording.hpp"

#include "base/bytes.hpp"
#include "base/descriptor.hpp"
#include "base/file_access.hpp"
#include "base/hashing.hpp"
#include "protocol/wire.hpp"

#include <array>
#include <unistd.h>
#include <utility>

namespace triptych {

namespace {

constexpr std::array<char, 8> magic = {'T', 'R', 'I', 'P', 'T', 'R', 'E', 'C'};
constexpr size_t start_bytes = magic.size() + sizeof(uint32_t);
/// The last record of a finished recording, which holds the number of messages.
constexpr size_t end_bytes = sizeof(uint64_t) + 2 * sizeof(uint32_t);
constexpr uint32_t record_limit = body_limit + 4096;

/// A record: length of the content, the content, and a checksum of both that depends on their place in the
/// file.
uint32_t checksum_of(std::span<const std::byte> length_and_content, uint64_t offset) {
  return static_cast<uint32_t>(hash_bytes(length_and_content, offset));
}

}  // namespace

RecordingWriter::RecordingWriter(const std::filesystem::path& file, const RecordingHeader& header)
    : file_(file) {
  ByteWriter start;
  start.write(magic);
  start.write(recording_version);
  file_.append(start.bytes());
  ByteWriter content;
  content.write_text(header.pack);
  const std::vector<std::byte> hello = encode(header.own);
  content.write_all(std::span<const std::byte>(hello));
  append(content.bytes());
}

void RecordingWriter::append(std::span<const std::byte> record) {
  ByteWriter out;
  out.write(static_cast<uint32_t>(record.size()));
  out.write_all(record);
  out.write(checksum_of(out.bytes(), file_.size()));
  file_.append(out.bytes());
}

void RecordingWriter::add(const RecordedMessage& recorded) {
  ByteWriter content;
  content.write(recorded.time_ms);
  content.write(static_cast<uint8_t>(recorded.sent));
  content.write(recorded.peer);
  content.write(recorded.channel);
  const std::vector<std::byte> wire = encode(recorded.message);
  content.write_all(std::span<const std::byte>(wire));
  append(content.bytes());
  ++count_;
}

RecordingWriter::~RecordingWriter() {
  try {
    finish();
  } catch (const Error&) {
    // The disk is full: the recording ends here, and is reported as cut when it is read.
  }
}

void RecordingWriter::finish() {
  if (std::exchange(finished_, true)) return;
  // The end record holds the number of messages; no message is as short.
  ByteWriter content;
  content.write(count_);
  append(content.bytes());
}

RecordingReader::RecordingReader(std::filesystem::path file)
    : path_(std::move(file)), file_(open_to_read(path_)) {
  size_ = size_of(file_.number(), path_.string());
  read_header();
}

void RecordingReader::read_header() {
  const std::string path = path_.string();
  if (size_ < start_bytes) fail(path, "is not a recording of a session");
  std::array<std::byte, start_bytes> bytes{};
  read_at(file_.number(), 0, bytes, path);
  ByteReader start(bytes, path);
  if (start.read<std::array<char, magic.size()>>() != magic) fail(path, "is not a recording of a session");
  if (const auto version = start.read<uint32_t>(); version != recording_version) {
    fail(path, "is a recording of version {}; this program reads version {}", version, recording_version);
  }
  offset_ = start_bytes;
  const std::vector<std::byte> record = read_record();
  ByteReader content(record, path);
  header_.pack = content.read_text();
  const Message hello = decode(content.read_all<std::byte>(content.left()), path);
  if (!std::holds_alternative<Hello>(hello)) fail(path, "does not start with who recorded it");
  header_.own = std::get<Hello>(hello);
}

std::string RecordingReader::place() const { return fmt::format("{} byte {}", path_.string(), offset_); }

bool RecordingReader::was_finished() const {
  std::array<std::byte, end_bytes> bytes{};
  if (size_ < start_bytes + end_bytes) return false;
  read_at(file_.number(), size_ - end_bytes, bytes, path_.string());
  ByteReader end(bytes, path_.string());
  if (end.read<uint32_t>() != sizeof(uint64_t)) return false;
  end.read<uint64_t>();
  const auto checked = std::span<const std::byte>(bytes).first(end_bytes - sizeof(uint32_t));
  return end.read<uint32_t>() == checksum_of(checked, size_ - end_bytes);
}

void RecordingReader::fail_too_short() const {
  // A finished recording cannot have been cut, so the length must be wrong.
  if (was_finished()) fail(place(), "the recording is damaged: a record that is longer than what is left");
  throw RecordingCut(place(), fmt::format("the recording is cut here, after {} messages", count_));
}

std::vector<std::byte> RecordingReader::read_record() {
  const uint64_t left = size_ - offset_;
  if (left < sizeof(uint32_t)) fail_too_short();
  std::array<std::byte, sizeof(uint32_t)> length_bytes{};
  read_at(file_.number(), offset_, length_bytes, path_.string());
  const auto length = ByteReader(length_bytes, place()).read<uint32_t>();
  if (length > record_limit) fail(place(), "the recording is damaged: a record of {} bytes", length);
  if (left < 2 * sizeof(uint32_t) + length) fail_too_short();
  std::vector<std::byte> bytes(2 * sizeof(uint32_t) + length);
  read_at(file_.number(), offset_, bytes, path_.string());
  const auto checked = std::span<const std::byte>(bytes).first(sizeof(uint32_t) + length);
  const auto checksum =
      ByteReader(std::span<const std::byte>(bytes).last(sizeof(uint32_t)), place()).read<uint32_t>();
  if (checksum != checksum_of(checked, offset_)) fail(place(), "the recording is damaged: a wrong checksum");
  offset_ += bytes.size();
  return {checked.begin() + sizeof(uint32_t), checked.end()};
}

std::optional<RecordedMessage> RecordingReader::next() {
  const std::string where = place();
  const std::vector<std::byte> record = read_record();
  ByteReader content(record, where);
  if (record.size() == sizeof(uint64_t)) {
    if (content.read<uint64_t>() != count_) fail(where, "the recording is damaged: messages are missing");
    if (offset_ != size_) fail(place(), "the recording is damaged: it goes on after its end");
    offset_ -= end_bytes;  // the end stays the end
    return std::nullopt;
  }
  RecordedMessage recorded;
  recorded.time_ms = content.read<double>();
  recorded.sent = content.read<uint8_t>() != 0;
  const auto peer = content.read<uint8_t>();
  const auto channel = content.read<uint8_t>();
  if (peer >= all_roles.size() || channel >= all_channels.size()) fail(where, "a role that does not exist");
  recorded.peer = all_roles[peer];
  recorded.channel = all_channels[channel];
  recorded.message = decode(content.read_all<std::byte>(content.left()), where);
  ++count_;
  return recorded;
}

std::string recording_name(Role role, size_t start) {
  static const std::array<std::string, 3> names = {"render", "switch-0", "switch-1"};
  const std::string number = start > 1 ? fmt::format("-{}", start) : "";
  return names[static_cast<size_t>(role)] + number + ".recording";
}

std::vector<std::filesystem::path> recordings_of(Role role, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (size_t start = 1;; ++start) {
    const std::filesystem::path file = folder / recording_name(role, start);
    if (!std::filesystem::exists(file)) return files;
    files.push_back(file);
  }
}

}  // namespace triptych
