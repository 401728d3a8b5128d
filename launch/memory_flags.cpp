#include "launch/memory_flags.hpp"

#include "launch/choice_flag.hpp"
#include "launch/number_flags.hpp"

#include <CLI/CLI.hpp>

namespace triptych {

void add_memory_flags(CLI::App& command, MemoryCaps& caps) {
  command
      .add_option(
          "--memory", caps.memory,
          "What the process may take, in bytes (suffixes K, M, G); where that cannot hold what a frame "
          "shows, the pixel error rises")
      ->transform(bytes_from(1, "1"))
      ->type_name("BYTES");
  command
      .add_option("--device-memory", caps.device_memory,
                  "What geometry on the device may take, in bytes; on cpu the device is the process")
      ->transform(bytes_from(1, "1"))
      ->type_name("BYTES");
  const std::map<std::string, OnMiss> names{{"exact", OnMiss::exact}, {"coarser", OnMiss::coarser}};
  add_choice_flag(
      command, "--on-miss", caps.on_miss, names,
      "What a frame does about geometry that is still to be read: it waits, or draws what is coarser")
      ->default_str("exact");
}

}  // namespace triptych
