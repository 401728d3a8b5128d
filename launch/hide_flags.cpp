#include "launch/hide_flags.hpp"

#include <nlohmann/json.hpp>

namespace triptych {

void add_hide_flags(CLI::App& command, RunOptions& options) {
  command
      .add_option("--hide", options.hide,
                  "Hide the objects that a word means, as find has it: a word of their names, or "
                  "layer:NAME, storey:NAME, type:NAME, file:NAME; again for more")
      ->type_name("WORD")
      ->allow_extra_args(false);
  command.add_option("--isolate", options.isolate, "Hide all other objects; again for more that stay")
      ->type_name("WORD")
      ->allow_extra_args(false);
}

void add_hidden(nlohmann::json& report, const HiddenName& hidden) { report["hidden_objects"] = hidden.count; }

}  // namespace triptych
