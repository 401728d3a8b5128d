#include "launch/viewpoint_flags.hpp"

#include "launch/number_flags.hpp"

namespace triptych {

void add_viewpoint_flags(CLI::App& command, FirstViewpoint& viewpoint) {
  CLI::Option* bcf = command.add_option("--bcf", viewpoint.bcf, "Begin at a viewpoint of this BCF file")
                         ->type_name("FILE")
                         ->excludes("--path");
  command.add_option("--viewpoint", viewpoint.number, "Which of them, from 1 on")
      ->needs(bcf)
      ->check(whole_number(1, 1'000'000))
      ->capture_default_str();
}

}  // namespace triptych
