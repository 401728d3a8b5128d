#include "base/hashing.hpp"
#include "base/progress.hpp"
#include "base/signals.hpp"
#include "launch/hide_flags.hpp"
#include "launch/measure.hpp"
#include "launch/number_flags.hpp"
#include "launch/session_flags.hpp"
#include "launch/text_table.hpp"
#include "measure/json.hpp"
#include "measure/session_report.hpp"
#include "nodes/local_pipeline.hpp"
#include "session/open_pack.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

/// The frames of a session that plays the path `times` times.
std::vector<FrameRequest> played(const std::vector<FrameRequest>& path, size_t times) {
  std::vector<FrameRequest> frames;
  for (size_t i = 0; i < times * path.size(); ++i) {
    frames.push_back(path[i % path.size()]);
    frames.back().number = static_cast<uint32_t>(i);
  }
  return frames;
}

/// The same path in one process, with each picture's hash.
std::vector<FrameRecord> run_one_process(const Pack& pack, const RunOptions& run, const DeviceOptions& device,
                                         const std::vector<FrameRequest>& requests) {
  LocalPipeline pipeline(pack, {.width = run.size.width, .height = run.size.height, .device = device});
  std::vector<FrameRecord> records;
  Progress progress("one process", requests.size());
  for (const FrameRequest& request : requests) {
    records.push_back(pipeline.draw(request));
    const std::vector<uint8_t> colors = pipeline.target().read_colors();
    records.back().picture_hash = hash_values(std::span<const uint8_t>(colors));
    progress.advance();
    end_if_asked("one process");
  }
  return records;
}

/// The same session at each packet size. Every one must show the same pictures.
std::vector<SessionOutcome> run_sessions(const SessionOptions& options) {
  std::vector<SessionOutcome> outcomes;
  for (const size_t batch : options.batches) {
    SessionOptions one = options;
    one.batches = {batch};
    if (!outcomes.empty()) one.record = one.timeline = "";  // only those of the first one are wanted
    outcomes.push_back(run_session(one));
    end_if_asked("measure session");
    const std::vector<FrameRecord>& frames = outcomes.back().records.front().frames;
    const std::vector<FrameRecord>& first = outcomes.front().records.front().frames;
    for (size_t i = 0; i < frames.size(); ++i) {
      if (frames[i].picture_hash != first.at(i).picture_hash) {
        fail("measure session", "frame {} differs between packets of {} and of {} ids", i,
             options.batches.front(), batch);
      }
    }
  }
  return outcomes;
}

void print_batches(const nlohmann::json& rows) {
  std::vector<std::vector<std::string>> lines;
  for (const nlohmann::json& row : rows) {
    lines.push_back({in_threes(row["batch"].get<double>()),
                     in_threes(row["bytes_per_frame"].get<double>(), 1),
                     in_threes(row["packets_per_frame"].get<double>(), 2),
                     in_threes(row["camera_to_image_ms"]["p50"].get<double>(), 1),
                     in_threes(row["frame_ms"]["p50"].get<double>(), 1),
                     in_threes(row["frame_ms"]["p95"].get<double>(), 1)});
  }
  fmt::print(
      "{}",
      text_table({"ids per packet", "bytes per frame", "packets", "latency ms", "frame ms", "p95"}, lines));
}

void print_latency_and_traffic(const nlohmann::json& report) {
  const auto mean = [&](const char* part) { return report["latency_ms"][part]["mean"].get<double>(); };
  fmt::print(
      "camera to image {:.1f} ms on average: waiting {:.1f}, occlusion representation {:.1f}, hardware cull "
      "{:.1f}, network {:.1f}, render {:.1f}, {:.2f} left\n",
      mean("whole"), mean("waiting"), mean("occlusion_representation"), mean("hardware_cull"),
      mean("network"), mean("render"), mean("remainder"));
  const nlohmann::json& traffic = report["traffic"];
  fmt::print(
      "{:.1f} bytes per frame: {:.1f} % of the paper's formula at 4 bytes for each visible id; delta bodies "
      "{:.1f} % of 4 bytes for each id that changed\n",
      traffic["bytes_per_frame"].get<double>(), 100 * traffic["share_of_formula_whole_sets"].get<double>(),
      100 * traffic["share_of_4_bytes_per_id"]["bodies"].get<double>());
}

int run(SessionOptions options) {
  options.hash = true;
  // Opened before the sessions, as they do: pictures are compared with this one, whatever becomes of the
  // file.
  const Pack pack = open_pack(options.run.pack);
  std::vector<FrameRequest> requests = played(load_frames(options.run, pack), options.loop);
  std::vector<SessionOutcome> outcomes = run_sessions(options);
  nlohmann::json batches = nlohmann::json::array();
  for (size_t i = 0; i < outcomes.size(); ++i)
    batches.push_back(batch_json(options.batches[i], outcomes[i].records));
  SessionOutcome outcome = std::move(outcomes.front());
  outcomes.clear();
  SessionMeasurement measurement{.requests = std::move(requests),
                                 .roles = std::move(outcome.records),
                                 .session = {},
                                 .fallback = {},
                                 .one_process = {}};
  const ChosenDevice device = choose_device(options.run.device);
  if (!(device.names == measurement.roles.front().device)) {
    fail("measure session", "the comparison's device is not the session's: {}, and not {}",
         device.names.renderer, measurement.roles.front().device.renderer);
  }
  measurement.one_process = run_one_process(pack, options.run, device.options, measurement.requests);
  const std::vector<Comparison> comparisons =
      compare(pack, device.options, measurement.requests,
              {&measurement.roles.front().frames, &measurement.one_process});
  measurement.session = comparisons[0];
  measurement.fallback = comparisons[1];
  nlohmann::json report = session_report(pack, measurement);
  report["batches"] = batches;
  add_picture(report, options.run);
  add_hidden(report, outcome.hidden);
  if (batches.size() > 1) print_batches(batches);
  fmt::print(
      "{} frames, median {:.1f} ms (one process {:.1f} ms); {} of {} identical to the un-culled picture\n",
      measurement.requests.size(), report["frame_ms"]["p50"].get<double>(),
      report["one_process"]["frame_ms"]["p50"].get<double>(), measurement.session.identical_frames,
      measurement.session.frames_compared);
  fmt::print(
      "drawn over visible {:.2f}; deltas save {:.1f} % of ids, {:.2f} bytes per id; {:.2f} Mbit/s (formula "
      "{:.2f})\n",
      measurement.session.culling_efficiency(), report["delta"]["saved_percent"].get<double>(),
      report["delta"]["body_bytes_per_id"].get<double>(), report["mbit_per_s"]["measured"].get<double>(),
      report["mbit_per_s"]["formula"].get<double>());
  print_latency_and_traffic(report);
  write_json(options.run.json, report);
  if (measurement.session.identical_frames != measurement.session.frames_compared) {
    fail("measure session", "frame {} is not the un-culled picture, and {} frames in all",
         measurement.session.different.front(), measurement.session.different.size());
  }
  return 0;
}

}  // namespace

void add_measure_session(CLI::App& measure, Action& action) {
  auto options = std::make_shared<SessionOptions>();
  CLI::App* session = measure.add_subcommand(
      "session", "A session measured, every frame compared with the un-culled picture of the same cut");
  session->footer("Example: triptych measure session scene.tpk --path walk.json --json session.json");
  options->gather_s = 20;  // what is measured is all three of them
  add_run_flags(*session, options->run);
  add_session_flags(*session, *options);
  take_list(session->get_option("--batch"));
  session->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace triptych
