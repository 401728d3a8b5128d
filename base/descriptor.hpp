// Open files: their ownership, and complete reads and writes, however many calls they take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>

namespace triptych {

/// The number of an open file, pipe or socket, which is closed with this object.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }

  bool is_open() const { return number_ >= 0; }
  int number() const { return number_; }  ///< -1 where nothing is open
  void close();
  /// Gives up ownership: the caller closes it.
  [[nodiscard]] int release() { return std::exchange(number_, -1); }

 private:
  int number_ = -1;
};

/// How many bytes the file has. Error (place) if that cannot be found out.
uint64_t size_of(int descriptor, const std::string& place);

/// Fills `into` from the file's offset on. Error (place, byte) if it cannot be read or ends before.
void read_at(int descriptor, uint64_t offset, std::span<std::byte> into, const std::string& place);

/// Hands out the first `size` bytes of the file, a megabyte at a time. Error as of read_at().
void read_in_stretches(int descriptor, uint64_t size, const std::string& place,
                       const std::function<void(std::span<const std::byte>)>& take);

/// Writes all bytes at the file's current offset. Error (place) if that fails.
void write_all(int descriptor, std::span<const std::byte> bytes, const std::string& place);

}  // namespace triptych
