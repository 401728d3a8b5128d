// A furniture model as the sample scenes use it: OBJ and MTL from a catalogue's archive, scaled to catalogue
// size.
#pragma once

#include "samples/building/furniture_catalog.hpp"
#include "samples/mesh_part.hpp"

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace triptych {

struct FurnitureMesh {
  std::vector<MeshPart> parts;  ///< one per material, in the order of first use; none is empty
  uint64_t triangles = 0;
  uint64_t collapsed_triangles = 0;  ///< dropped: two corners at one place
  /// Textures that are missing or unreadable: the material's own colour stands.
  uint64_t undecoded_images = 0;
  uint64_t undefined_materials = 0;    ///< used but nowhere defined: a light grey stands
  uint64_t transparent_materials = 0;  ///< drawn opaque, but where glass is shown
};

/// Reads the piece's model. Polygons become fans; the model is turned by the catalogue's rotation, and its
/// box scaled to the catalogue's size, centred on x and z, standing on y = 0 (Sweet Home 3D's convention).
/// Error (place: archive, file, line) for a model that cannot be read or has no triangles.
/// shows_glass: transparent materials are transparent.
FurnitureMesh read_furniture(const FurniturePiece& piece, const ZipArchive& archive,
                             bool shows_glass = false);

}  // namespace triptych
