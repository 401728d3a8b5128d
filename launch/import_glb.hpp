// Writes what Assimp read as a binary glTF file, which the importer of triptych can check and read.
#pragma once

#include <assimp/scene.h>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <map>
#include <string>

namespace triptych {

/// Counts of what is left out or worth knowing, "<count> <what>" each.
using ConversionNotes = std::map<std::string, uint64_t>;

/// Writes nodes, meshes as triangles, and base colours to an open file. Transforms are doubles in the file;
/// `to_model` scales to metres and turns to y up. Error (place) for a scene that is too large for the
/// format or has indices out of range.
void write_glb(const aiScene& scene, const glm::dmat3& to_model, int descriptor, const std::string& place,
               ConversionNotes& notes);

/// The largest coordinate and offset in the scene.
double largest_coordinate_of(const aiScene& scene);

}  // namespace triptych
