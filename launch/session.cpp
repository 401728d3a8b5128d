#include "base/notice.hpp"
#include "launch/session_run.hpp"
#include "measure/json.hpp"
#include "measure/session_report.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

int run(const SessionOptions& options, const std::filesystem::path& json) {
  const SessionOutcome outcome = run_session(options);
  nlohmann::json roles = nlohmann::json::array();
  for (const auto& [role, pid] : outcome.roles) roles.push_back({{"role", role}, {"pid", pid}});
  if (outcome.stopped) notice("session: told to end, every role has left");
  const std::vector<FrameRecord>& frames = outcome.records.front().frames;
  uint64_t mismatches = 0, fallback_frames = 0;
  for (const FrameRecord& frame : frames) {
    mismatches += frame.digest_mismatch;
    fallback_frames += frame.fallback;
  }
  nlohmann::json report = {
      {"frames", frames.size()},
      {"frame_ms", distribution_json(frames, [](const FrameRecord& r) { return r.frame_ms; })},
      {"visible", distribution_json(frames, [](const FrameRecord& r) { return r.visible_count; })},
      {"drawn_triangles", distribution_json(frames, [](const FrameRecord& r) { return r.drawn_triangles; })},
      {"delta", delta_json(outcome.records)},
      {"digest_mismatches", mismatches},
      {"fallback_frames", fallback_frames},
      {"restarts", outcome.restarts},
      {"roles", roles}};
  if (options.hash) {
    report["pictures"] = nlohmann::json::array();
    for (const FrameRecord& frame : frames)
      report["pictures"].push_back(fmt::format("{:016x}", frame.picture_hash));
  }
  fmt::print("{} frames, median {:.1f} ms, {} by the render node alone, {} digest mismatches, {} restarts\n",
             frames.size(), report["frame_ms"]["p50"].get<double>(), fallback_frames, mismatches,
             outcome.restarts);
  write_json(json, report);
  return 0;
}

}  // namespace

void add_session(CLI::App& app, Action& action) {
  auto options = std::make_shared<SessionOptions>();
  CLI::App* sub = app.add_subcommand("session", "Three processes on this machine, one picture");
  sub->footer("Example: triptych session scene.tpk --path walk.json -o pictures");
  add_session_flags(*sub, *options);
  sub->add_option("-o,--output", options->output, "Folder for the PNG files")->type_name("DIR");
  sub->add_flag("--hash", options->hash, "Put each picture's hash into the JSON");
  sub->callback([options, &action] { action = [options] { return run(*options, options->run.json); }; });
}

}  // namespace triptych
