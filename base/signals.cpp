#include "base/signals.hpp"

#include "base/error.hpp"

#include <atomic>
#include <csignal>

namespace triptych {

namespace {

volatile std::sig_atomic_t stop_signal = 0;
std::atomic<bool> stop_without_signal{false};
void note_signal(int signal) { stop_signal = signal; }

bool install_handlers() {
  struct sigaction action {};
  action.sa_handler = note_signal;
  for (const int signal : {SIGTERM, SIGINT}) sigaction(signal, &action, nullptr);
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // ignored under nohup
  // The reader of our output may be gone.
  std::signal(SIGPIPE, SIG_IGN);
  return true;
}

}  // namespace

bool stop_requested() {
  static const bool installed = install_handlers();
  return installed && (stop_signal != 0 || stop_without_signal);
}

void request_stop() { stop_without_signal = true; }

int interrupted_exit_code() { return stop_signal == 0 ? 0 : 128 + stop_signal; }

void end_if_asked(const std::string& place) {
  if (stop_requested()) fail(place, "was told to end");
}

}  // namespace triptych
