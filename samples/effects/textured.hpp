// What in the exhibition has textures, holes, or light of its own.
#pragma once

#include "samples/mesh_part.hpp"

#include <filesystem>
#include <vector>

namespace triptych {

/// Writes the images that the parts name, into the folder.
void write_effect_images(const std::filesystem::path& folder);

/// A carpet of many squares that rises and falls a little, 6 by 1.2 metres around the origin; its image
/// repeats.
MeshPart carpet(bool textured);
/// A fence of wire, 4 by 1 metres from the origin on, in one plane: most of it is holes.
MeshPart fence(bool textured);
/// A tube that glows, above a sign whose letters do.
std::vector<MeshPart> lamp(bool textured, bool emissive);

}  // namespace triptych
