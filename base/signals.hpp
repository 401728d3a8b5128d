// Signals that ask this process to end.
#pragma once

#include <string>

namespace triptych {

/// Whether SIGTERM, SIGINT or SIGHUP (unless that is ignored, as by nohup) asked this process to end; the
/// first call installs the handlers.
bool stop_requested();
/// Error (place) if a signal asked this process to end: called where work can be interrupted safely.
void end_if_asked(const std::string& place);

}  // namespace triptych
