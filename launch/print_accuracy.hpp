// What `measure accuracy` says on the terminal.
#pragma once

#include <nlohmann/json.hpp>

namespace triptych {

/// A sentence a row, the advice for each pack and which frames they are about; broken promises go to standard
/// error. report: as accuracy_json() gives it, with "frames" and "frames_say"; perceptual: whether
/// butteraugli was there.
void print_accuracy(const nlohmann::json& report, bool perceptual);

}  // namespace triptych
