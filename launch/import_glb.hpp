// Writes what Assimp read as a binary glTF file, which the importer of triptych can check and read.
#pragma once

#include <assimp/scene.h>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace triptych {

/// Counts of what is left out or worth knowing, "<count> <what>" each.
using ConversionNotes = std::map<std::string, uint64_t>;

/// Writes nodes, meshes as triangles, and base colours to an open file. Transforms are doubles in the file;
/// `metres` scales to metres, `z_up` turns to y up. Error (place) for a scene that is too large for the
/// format or has indices out of range.
void write_glb(const aiScene& scene, double metres, bool z_up, int descriptor, const std::string& place,
               ConversionNotes& notes);

/// The largest coordinate and offset in the scene.
double largest_coordinate_of(const aiScene& scene);

}  // namespace triptych
