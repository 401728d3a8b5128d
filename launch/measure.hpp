// The subcommands of `measure`: one file each.
#pragma once

#include "launch/command.hpp"

namespace triptych {

void add_measure_accuracy(CLI::App& measure, Action& action);
void add_measure_session(CLI::App& measure, Action& action);
void add_measure_build(CLI::App& measure, Action& action);
void add_measure_yardstick(CLI::App& measure, Action& action);
void add_measure_effects(CLI::App& measure, Action& action);
void add_measure_building(CLI::App& measure, Action& action);
void add_measure_hiding(CLI::App& measure, Action& action);
void add_measure_hierarchy(CLI::App& measure, Action& action);
void add_measure_light(CLI::App& measure, Action& action);
void add_measure_simplifiers(CLI::App& measure, Action& action);
void add_measure_frame(CLI::App& measure, Action& action);
void add_measure_streaming(CLI::App& measure, Action& action);
void add_measure_roles(CLI::App& measure, Action& action);
void add_measure_target(CLI::App& measure, Action& action);
void add_measure_speed(CLI::App& measure, Action& action);

}  // namespace triptych
