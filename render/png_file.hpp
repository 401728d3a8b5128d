// Pictures as PNG files (libpng).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace triptych {

/// rgba: width × height × 4 bytes, rows from bottom to top (as FrameTarget reads them); alpha is dropped. The
/// file appears under its name only when it is complete. Error (the path) if it cannot be written.
void write_png(const std::filesystem::path& file, int width, int height, std::span<const uint8_t> rgba);

}  // namespace triptych
