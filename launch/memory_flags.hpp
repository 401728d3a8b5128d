// --memory, --device-memory and --on-miss.
#pragma once

#include "nodes/memory_caps.hpp"

#include <CLI/App.hpp>

namespace triptych {

void add_memory_flags(CLI::App& command, MemoryCaps& caps);

}  // namespace triptych
