// The bytes of a pack's file, to be changed by hand.
#pragma once

#include "base/error.hpp"
#include "base/hashing.hpp"
#include "scene/pack.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>

namespace triptych::test {

inline constexpr size_t header_bytes = 32, section_bytes = 32;

/// What opening the pack and reading every chunk of it says; empty if all is well.
inline std::string error_of(const std::filesystem::path& file) {
  try {
    const Pack pack(file);
    for (uint32_t i = 0; i < pack.skeleton().chunks.size(); ++i) pack.read_chunk(i);
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find(file.string()), 0u) << error.what();
    return std::string(error.what()).substr(file.string().size());
  }
  return "";
}

inline std::string error_of(std::filesystem::path file, const std::string& contents) {
  file += ".damaged";
  std::ofstream(file, std::ios::binary) << contents;  // write_file() waits for the disk
  return error_of(file);
}

template <typename Value>
Value value_at(const std::string& bytes, size_t offset) {
  Value value;
  std::memcpy(&value, bytes.data() + offset, sizeof(value));
  return value;
}

template <typename Value>
void put(std::string& bytes, size_t offset, Value value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(value));
}

/// Makes the table's checksum in the header right again after a change of the table.
inline void seal_table(std::string& bytes) {
  const auto table = value_at<uint64_t>(bytes, 16);
  const auto size = value_at<uint32_t>(bytes, 12) * section_bytes;
  put(bytes, 24,
      hash_bytes(std::as_bytes(std::span(bytes.data() + table, size)), value_at<uint32_t>(bytes, 8)));
}

}  // namespace triptych::test
