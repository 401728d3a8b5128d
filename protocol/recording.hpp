// A session as its messages: what one role sent and received, each with its time, in one file that can be
// replayed.
#pragma once

#include "base/error.hpp"
#include "base/spool_file.hpp"
#include "protocol/messages.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

inline constexpr uint32_t recording_version = 1;

/// A message as it passed a role.
struct RecordedMessage {
  double time_ms = 0;  ///< the role's steady clock when it was sent or received
  bool sent = false;   ///< by this role to the peer; otherwise the other way
  Role peer = Role::render;
  Channel channel = Channel::camera;
  Message message;
  bool operator==(const RecordedMessage&) const = default;
};

/// Which role recorded it, and which pack the role had opened.
struct RecordingHeader {
  Hello own;
  std::string pack;  ///< the pack's path, as given to the role
  bool operator==(const RecordingHeader&) const = default;
};

/// A recording that ends too soon, for instance because its role was killed.
class RecordingCut : public Error {
 public:
  using Error::Error;
};

/// Writes messages as they are sent and received. A message for which add() has returned survives the end of
/// the process, however it ends; the recording of a killed process counts as cut.
class RecordingWriter {
 public:
  /// Makes or replaces the file. Error (path) where that fails.
  RecordingWriter(const std::filesystem::path& file, const RecordingHeader& header);
  ~RecordingWriter();  ///< finishes it, unless finish() did
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;
  void add(const RecordedMessage& message);
  void finish();

 private:
  void append(std::span<const std::byte> record);
  SpoolFile file_;
  uint64_t count_ = 0;
  bool finished_ = false;
};

/// Reads a recording message by message. Error (file, byte) for a file that is not a recording, for another
/// version, and for damage: every changed byte is noticed. A recording that ends too soon is a RecordingCut,
/// at the place where it ends.
class RecordingReader {
 public:
  explicit RecordingReader(std::filesystem::path file);
  const RecordingHeader& header() const { return header_; }
  /// The next message, or nothing after the last.
  std::optional<RecordedMessage> next();

 private:
  void read_header();
  bool was_finished() const;
  [[noreturn]] void fail_too_short() const;
  std::vector<std::byte> read_record();
  std::string place() const;

  std::filesystem::path path_;
  Descriptor file_;
  uint64_t size_ = 0, offset_ = 0, count_ = 0;
  RecordingHeader header_;
};

/// "render.recording", "switch-0.recording"; the n-th file of a role that was started again has a number:
/// "switch-0-2.recording".
std::string recording_name(Role role, size_t start = 1);
/// The role's recordings in the folder, in the order of its starts.
std::vector<std::filesystem::path> recordings_of(Role role, const std::filesystem::path& folder);

}  // namespace triptych
