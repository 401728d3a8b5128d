// Starts other programs, with pipes to them.
#pragma once

#include "base/descriptor.hpp"

#include <csignal>
#include <string>
#include <sys/types.h>
#include <vector>

namespace triptych {

struct Pipe {
  Descriptor read, write;
};
/// Programs that are started inherit neither end. Error (place) if there are no pipes left.
Pipe open_pipe(const std::string& place);

struct Program {
  std::string file;
  std::vector<std::string> words;  ///< its arguments; the first is its name
  /// An open file of this process, which the program gets under another number.
  struct Handed {
    int ours = -1, theirs = -1;
  };
  std::vector<Handed> descriptors;
  int death_signal = SIGTERM;  ///< the signal that it gets when this process dies
  /// Signals that it handles by default or ignores, whatever this process does.
  std::vector<int> default_signals, ignored_signals;
};

/// The first program of this name on the PATH; empty if there is none.
std::string find_program(const std::string& name);

/// Starts the program; the caller waits for its end. One that cannot be executed ends with exit code 127.
/// Error (place) if no further process can be made.
pid_t start_program(const Program& program, const std::string& place);

}  // namespace triptych
