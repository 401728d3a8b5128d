// The sample `kit` by OpenCASCADE: boundary representations.
#pragma once

#include <filesystem>
#include <string>

namespace triptych {

/// step and igs.
bool opencascade_writes(const std::string& format);
/// Metres, z up; storeys are assemblies. Error (OpenCASCADE) if that fails.
void write_kit_with_opencascade(const std::string& format, const std::filesystem::path& file);

}  // namespace triptych
