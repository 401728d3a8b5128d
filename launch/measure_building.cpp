#include "base/distribution.hpp"
#include "launch/measure.hpp"
#include "launch/number_flags.hpp"
#include "measure/json.hpp"
#include "measure/portal_trial.hpp"
#include "session/open_pack.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

int run(const RunOptions& run) {
  const Pack pack = open_pack(run.pack);
  const std::vector<FrameRequest> frames = load_frames(run, pack.skeleton());
  const ChosenDevice device = choose_device(run.device);
  const auto [width, height] = run.size;
  const PortalTrial trial =
      try_portals(pack, frames, {.width = width, .height = height, .device = device.options});
  const auto spread = [](const std::vector<double>& values) { return distribution(values); };
  const Distribution share = spread(trial.polygons_share), drawn = spread(trial.drawn_triangles),
                     owned = spread(trial.owners_triangles), through = spread(trial.frame_ms),
                     tested = spread(trial.occlusion_ms);
  nlohmann::json report = {{"cells", trial.cells->cells.size()},
                           {"portals", trial.cells->portals.size() / 2},
                           {"wall_triangles", trial.cells->wall_triangles},
                           {"subdivision_seconds", trial.subdivision_seconds},
                           {"visibility_seconds", trial.visibility_seconds},
                           {"polygons_share", to_json(share)},
                           {"drawn_triangles", to_json(drawn)},
                           {"owners_triangles", to_json(owned)},
                           {"frame_ms", to_json(through)},
                           {"occlusion_frame_ms", to_json(tested)}};
  add_device(report, device.names);
  add_picture(report, run);
  fmt::print(
      "{} cells and {} portals of {} wall triangles: divided in {:.2f} s, portals found in {:.2f} s\n"
      "without levels of detail {:.2f} % of all polygons are drawn ({:.2f} % at most)\n"
      "with them {:.0f} triangles a frame in the median, {:.0f} of drawables that own a pixel; {:.2f} ms, by "
      "occlusion {:.2f} ms\n",
      trial.cells->cells.size(), trial.cells->portals.size() / 2, trial.cells->wall_triangles,
      trial.subdivision_seconds, trial.visibility_seconds, 100 * share.mean, 100 * share.max, drawn.p50,
      owned.p50, through.p50, tested.p50);
  write_json(run.json, report);
  return 0;
}

}  // namespace

void add_measure_building(CLI::App& measure, Action& action) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* building = measure.add_subcommand(
      "building", "What cells and portals leave of a walk, and what finding them takes");
  building->footer("Example: triptych measure building scene.tpk --path walk.json --json building.json");
  add_run_flags(*building, *options);
  add_picture_flags(*building, *options);
  add_every_flag(*building, *options);
  building->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace triptych
