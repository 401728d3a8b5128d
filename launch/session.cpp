#include "base/notice.hpp"
#include "launch/hide_flags.hpp"
#include "launch/memory_flags.hpp"
#include "launch/output_folder.hpp"
#include "launch/session_flags.hpp"
#include "launch/viewpoint_flags.hpp"
#include "measure/json.hpp"
#include "measure/session_faults.hpp"
#include "measure/session_report.hpp"
#include "measure/steering_report.hpp"
#include "measure/streaming_report.hpp"
#include "view/viewer.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <optional>

namespace triptych {

namespace {

/// What each role took.
nlohmann::json memory_of_roles(const std::vector<RoleRecord>& records) {
  nlohmann::json roles = nlohmann::json::object();
  for (size_t i = 0; i < all_roles.size(); ++i) {
    const RoleRecord& role = records.at(i);
    roles[role_name(all_roles[i])] = {{"peak_rss_bytes", role.peak_rss_bytes},
                                      {"peak_device_bytes", role.memory.geometry.peak_bytes},
                                      {"bytes_read", role.memory.geometry.read_bytes},
                                      {"evicted_chunks", role.memory.geometry.evicted_chunks},
                                      {"chunks_left_out", role.memory.geometry.left_out}};
  }
  return roles;
}

int run(const SessionOptions& options, const std::string& line) {
  const std::filesystem::path& json = options.run.json;
  std::optional<OutputFolder> claimed;
  if (!options.output.empty()) {
    claimed.emplace(options.output, line);
    claimed->share_with_children();
  }
  if (options.window) say(viewer_help());
  const SessionOutcome outcome = run_session(options);
  nlohmann::json roles = nlohmann::json::array();
  for (const auto& [role, pid] : outcome.roles) roles.push_back({{"role", role}, {"pid", pid}});
  if (claimed && !outcome.stopped && outcome.exit_code == 0) claimed->finish();
  if (outcome.stopped) notice("session: told to end, every role has left");
  const std::vector<FrameRecord>& frames = outcome.records.front().frames;
  uint64_t mismatches = 0, fallback_frames = 0, coarser_frames = 0;
  for (const FrameRecord& frame : frames) {
    mismatches += frame.digest_mismatch;
    fallback_frames += frame.fallback;
    coarser_frames += frame.owed_drawables > 0 || frame.left_out_drawables > 0;
  }
  // A role that was killed and not started again has left no record.
  const bool same_device =
      std::all_of(outcome.records.begin(), outcome.records.end(), [&](const RoleRecord& role) {
        return role.device.vendor.empty() || role.device == outcome.records.front().device;
      });
  nlohmann::json restarted = nlohmann::json::array(), waiting = nlohmann::json::object();
  for (const RestartedRole& role : outcome.restarted)
    restarted.push_back({{"role", role.role}, {"pid", role.pid}, {"reason", role.reason}});
  for (size_t i = 0; i < all_roles.size(); ++i) {
    const Backlog& most = outcome.records.at(i).max_backlog;
    waiting[role_name(all_roles[i])] = {{"messages", most.messages}, {"bytes", most.bytes}};
  }
  nlohmann::json report = {
      {"frames", frames.size()},
      {"frame_ms", distribution_json(frames, [](const FrameRecord& r) { return r.frame_ms; })},
      {"visible", distribution_json(frames, [](const FrameRecord& r) { return r.visible_count; })},
      {"drawn_triangles", distribution_json(frames, [](const FrameRecord& r) { return r.drawn_triangles; })},
      {"delta", delta_json(outcome.records)},
      {"digest_mismatches", mismatches},
      {"fallback_frames", fallback_frames},
      {"faults", faults_json(frames)},
      {"restarts", outcome.restarted.size()},
      {"restarted", restarted},
      {"most_waiting", waiting},
      {"pictures_are", coarser_frames > 0 ? "coarser"
                       : same_device      ? "identical"
                                          : "conservative"},
      {"roles", roles}};
  if (!outcome.records.front().device.vendor.empty()) add_device(report, outcome.records.front().device);
  add_picture(report, options.run);
  add_hidden(report, outcome.hidden);
  if (options.hash) {
    report["pictures"] = nlohmann::json::array();
    for (const FrameRecord& frame : frames)
      report["pictures"].push_back(fmt::format("{:016x}", frame.picture_hash));
  }
  fmt::print(
      "{} frames on {}, median {:.1f} ms, {} by the render node alone, {} digest mismatches, {} restarts\n",
      frames.size(), report.value("device", "no device"), report["frame_ms"]["p50"].get<double>(),
      fallback_frames, mismatches, outcome.restarted.size());
  if (options.run.target_ms > 0) {
    const std::string summary = add_steering(report, frames, options.run.target_ms, "busiest_role",
                                             outcome.records.front().cost_coefficients);
    fmt::print("{}", summary);
  }
  report["memory"] = memory_of_roles(outcome.records);
  if (const MemoryCaps& caps = options.run.device.memory; caps.streams()) {
    fmt::print("{}", add_streaming(report, frames, caps, outcome.records.front().memory));
    for (const FrameRecord& frame : frames) report["series"]["pixel_error"].push_back(frame.pixel_error);
  }
  write_json(json, report);
  return outcome.exit_code;
}

}  // namespace

void add_session(CLI::App& app, Action& action) {
  auto options = std::make_shared<SessionOptions>();
  auto model = std::make_shared<ShownModel>();
  CLI::App* sub = app.add_subcommand("session", "Three processes on this machine, one picture");
  sub->footer("Example: triptych session scene.tpk --path walk.json -o pictures");
  add_shown_run_flags(*sub, options->run, *model);
  add_session_flags(*sub, *options);
  add_target_flag(*sub, options->run);
  add_memory_flags(*sub, options->run.device.memory);
  sub->add_option("-o,--output", options->output, "Folder for the PNG files")->type_name("DIR");
  sub->add_flag("--hash", options->hash, "Put each picture's hash into the JSON");
  add_until_told_flag(*sub, options->until_told);
  add_window_flag(*sub, options->window);
  add_viewpoint_flags(*sub, options->viewpoint);
  sub->get_option("--bcf")->needs("--window");
  sub->callback([=, &action] {
    require_path(options->run, options->window);
    if (options->window) size_for_window(*sub, options->run);
    check_shown_model(*sub, *model);
    check_target_flag(options->run, options->strategy);
    action = [=] {
      options->run.pack = pack_of(*model, {options->run.json, options->timeline});
      return run(*options, run_line(*sub));
    };
  });
}

}  // namespace triptych
