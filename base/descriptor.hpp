// Whole reads and writes of open files, whatever the system does at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace triptych {

/// How many bytes the file has. Error (place) if that cannot be said.
uint64_t size_of(int descriptor, const std::string& place);

/// Fills `into` from the file's offset on. Error (place, byte) if it cannot be read or ends before.
void read_at(int descriptor, uint64_t offset, std::span<std::byte> into, const std::string& place);

/// Hands out the first `size` bytes of the file, a megabyte at a time. Error as of read_at().
void read_in_stretches(int descriptor, uint64_t size, const std::string& place,
                       const std::function<void(std::span<const std::byte>)>& take);

/// Writes all bytes where the file stands. Error (place) if the disk is full.
void write_all(int descriptor, std::span<const std::byte> bytes, const std::string& place);

}  // namespace triptych
