// The coordinates that model files have themselves.
#pragma once

#include "model/import/import.hpp"
#include "scene/model_system.hpp"

#include <optional>

namespace triptych {

/// By their formats, or, where those leave it open, by the options. Metres where a format defines its unit,
/// or each file names one of its own. Nullopt where files differ, and for archives, whose content is another
/// file's.
std::optional<ModelSystem> own_system(const std::vector<std::filesystem::path>& files,
                                      const ImportOptions& options);

}  // namespace triptych
