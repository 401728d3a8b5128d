// Model files in: glTF and GLB, OBJ, PLY, STL, by their extension.
#pragma once

#include "scene/model.hpp"

#include <filesystem>
#include <vector>

namespace triptych {

/// Reads every file into one model. What is dropped, merged or not understood stands in the model's report.
/// Error (file and place in it) for a file that is missing, damaged, empty of triangles or of an unknown
/// format.
Model import_model(const std::vector<std::filesystem::path>& files);

}  // namespace triptych
