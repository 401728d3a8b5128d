// The triangles of a mesh by their corners, from memory or from its file.
#pragma once

#include "model/mesh_stream.hpp"
#include "model/model.hpp"

#include <cstdint>

namespace triptych {

/// As MeshStream::read, for any mesh.
uint64_t read_mesh(const Mesh& mesh, const TakeTriangles& take);

}  // namespace triptych
