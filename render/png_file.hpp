// Pictures as PNG files (libpng).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// A PNG file's bytes; rgba as below. Error (place) if it cannot be encoded.
std::vector<std::byte> encode_png(int width, int height, std::span<const uint8_t> rgba,
                                  const std::string& place);

/// rgba: width × height × 4 bytes, rows from bottom to top (as FrameTarget reads them); alpha is dropped. The
/// file appears under its name only when it is complete. Error (the path) if it cannot be written.
void write_png(const std::filesystem::path& file, int width, int height, std::span<const uint8_t> rgba);

}  // namespace triptych
