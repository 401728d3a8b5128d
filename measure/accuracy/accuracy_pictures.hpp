// The pictures of an accuracy report: the worst patches enlarged, and one frame at every pixel error.
#pragma once

#include "measure/accuracy/accuracy.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace triptych {

/// Writes PNG files into folder/pictures and returns {"strip": [{pixel_error, file, difference}], "patches":
/// [{kind, row, frame, pixels, left, top, reference, shown, difference}]}: names relative to the folder; of
/// each kind (hole, swap, deviation) the worst of each pixel error. Error (the path) where that fails.
nlohmann::json write_accuracy_pictures(const AccuracyResult& result, const std::filesystem::path& folder);

}  // namespace triptych
