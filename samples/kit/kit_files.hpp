// The kit in the formats that the program writes itself.
#pragma once

#include <filesystem>

namespace triptych {

/// `kit.gltf` and `kit.bin`: a node for each storey, and one in it for each of its solids. Errors as of
/// write_file().
void write_kit_gltf(const std::filesystem::path& folder);
/// `kit.glb`, from the two.
void write_kit_glb(const std::filesystem::path& folder);
/// `kit.dxf`: a layer for each solid, with its true colour; faces of three corners; metres, z up.
void write_kit_dxf(const std::filesystem::path& folder);
/// `kit.3mf`: an object with a name for each solid, its colour a base material; metres, z up. Error (the
/// file) if it cannot be written.
void write_kit_3mf(const std::filesystem::path& folder);
/// The plan as JSON, for the script that writes IFC: `storeys` (name, elevation) and `solids` (name, storey,
/// colour 0 to 1, upright, outline, from, to).
void write_kit_plan(const std::filesystem::path& file);

}  // namespace triptych
