// Signals that ask this process to end.
#pragma once

#include <string>

namespace triptych {

/// Whether SIGTERM, SIGINT or SIGHUP (unless that is ignored, as by nohup) asked this process to end; the
/// first call installs the handlers.
bool stop_requested();
/// From now on stop_requested(), without a signal.
void request_stop();
/// What a program returns that a signal ended before it was done, as shells have it: 128 and the signal's
/// number. 0 where none asked.
int interrupted_exit_code();
/// Error (place) if a signal asked this process to end: called where work can be interrupted safely.
void end_if_asked(const std::string& place);

}  // namespace triptych
