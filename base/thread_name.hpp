// Names of threads and processes, as top shows them.
#pragma once

#include <sys/prctl.h>

namespace triptych {

/// Names the calling thread; the first thread's name is its process's. Of more than 15 characters the rest is
/// dropped. Threads begin with the name of the thread that made them.
inline void name_thread(const char* name) { ::prctl(PR_SET_NAME, name); }

}  // namespace triptych
