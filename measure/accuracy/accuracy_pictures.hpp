// The pictures of an accuracy report: the worst patches enlarged, and one frame at every pixel error.
#pragma once

#include "measure/accuracy/accuracy.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace triptych {

/// Writes PNG files into folder/pictures, in place of those of an earlier run, and returns {"strip":
/// [{pixel_error, frame, file, difference}], "patches": [{kind, row, rows, frame, pixels, x, y, enlarged,
/// reference, shown, difference}]}: names relative to the folder. Of each kind (hole, swap, deviation) the
/// worst of each row; one that looks the same in several rows is there once, with all of them in `rows`. A
/// frame marks the place. Error (the path) where that fails.
nlohmann::json write_accuracy_pictures(const AccuracyResult& result, const std::filesystem::path& folder);

}  // namespace triptych
