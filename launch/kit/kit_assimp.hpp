// The sample `kit` by Assimp's exporters.
#pragma once

#include <filesystem>
#include <string>

namespace triptych {

/// obj, ply, stl, dae, 3ds, x3d and fbx.
bool assimp_writes(const std::string& format);
/// Error (Assimp) if that fails.
void write_kit_with_assimp(const std::string& format, const std::filesystem::path& file);

}  // namespace triptych
