#include "launch/measure.hpp"

namespace triptych {

void add_measure(CLI::App& app, Action& action) {
  CLI::App* measure = app.add_subcommand("measure", "Measure what a run costs and how correct it is");
  measure->require_subcommand(1);
  measure->footer("Example: triptych measure session scene.tpk --path walk.json --json session.json");
  add_measure_session(*measure, action);
  add_measure_build(*measure, action);
  add_measure_yardstick(*measure, action);
  add_measure_hierarchy(*measure, action);
  add_measure_simplifiers(*measure, action);
  add_measure_light(*measure, action);
  add_measure_frame(*measure, action);
  add_measure_effects(*measure, action);
  add_measure_building(*measure, action);
  add_measure_hiding(*measure, action);
  add_measure_roles(*measure, action);
  add_measure_target(*measure, action);
  add_measure_streaming(*measure, action);
  add_measure_speed(*measure, action);
  add_measure_accuracy(*measure, action);
}

}  // namespace triptych
