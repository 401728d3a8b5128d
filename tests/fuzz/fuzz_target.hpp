// What every fuzz target is: libFuzzer calls it with inputs that it makes up, replay.cpp with files.
#pragma once

#include "model/import/import_file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);  // libFuzzer's name

namespace triptych::fuzz {

/// Puts the bytes into a file in memory and returns its path; the next call overwrites it.
std::filesystem::path file_of(std::span<const uint8_t> bytes);

/// Imports the bytes as a file, in memory and as streams. An Error is fine; what the file holds in memory it
/// must hold as a stream too, indices must be in range and coordinates finite. Anything else ends the
/// process.
void import_both_ways(std::span<const uint8_t> bytes, void (*import)(FileImport&));

}  // namespace triptych::fuzz
