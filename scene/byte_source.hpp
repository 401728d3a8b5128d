// The seam to where the bytes of a pack are: a file, or a server.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace triptych {

/// Bytes at a range. Safe to read from several threads; what is read stays the same from first to last.
class ByteSource {
 public:
  ByteSource() = default;
  virtual ~ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  virtual const std::string& name() const = 0;
  virtual uint64_t size() const = 0;
  /// Fills `into` from the offset on; all of it lies within size(). Error (place) where that cannot be.
  virtual void read(uint64_t offset, std::span<std::byte> into, const std::string& place) const = 0;

  /// How it likes to be read.
  struct Habits {
    size_t threads = 2;         ///< that read side by side
    uint64_t most_at_once = 0;  ///< bytes of several chunks that are better read together; 0: each by itself
    uint64_t unasked = 0;       ///< bytes between them that are better read along than left out
    bool far = false;           ///< nothing is read of it while a frame could be drawn, if that can be helped
  };
  virtual Habits habits() const { return {}; }
};

}  // namespace triptych
