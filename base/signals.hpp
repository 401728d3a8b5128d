// Signals that ask this process to end: one place that hears them.
#pragma once

#include <string>

namespace triptych {

/// Whether SIGTERM, SIGINT or SIGHUP (unless that is ignored, as by nohup) asked this process to end; the
/// first call installs the handlers.
bool stop_requested();
/// Error (place) where that was asked: for work between two things that can be left as they are.
void end_if_asked(const std::string& place);

}  // namespace triptych
