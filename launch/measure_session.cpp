#include "base/hashing.hpp"
#include "base/progress.hpp"
#include "launch/measure.hpp"
#include "launch/session_run.hpp"
#include "measure/json.hpp"
#include "measure/session_report.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

/// The same path in one process, with each picture's hash.
std::vector<FrameRecord> run_one_process(const Pack& pack, const RunOptions& run,
                                         const std::vector<FrameRequest>& requests) {
  Fallback fallback(pack,
                    {.width = run.size.width, .height = run.size.height, .test = run.test, .batches = {}});
  std::vector<FrameRecord> records;
  Progress progress("one process", requests.size());
  for (const FrameRequest& request : requests) {
    records.push_back(fallback.draw(request));
    const std::vector<uint8_t> colors = fallback.target().read_colors();
    records.back().picture_hash = hash_values(std::span<const uint8_t>(colors));
    progress.advance();
  }
  return records;
}

int run(SessionOptions options) {
  options.hash = true;
  SessionOutcome outcome = run_session(options);
  if (outcome.stopped) return 0;
  const Pack pack(options.run.pack);
  SessionMeasurement measurement{.requests = load_frames(options.run, pack.skeleton()),
                                 .roles = std::move(outcome.records),
                                 .session = {},
                                 .fallback = {},
                                 .one_process = {}};
  const auto context = make_context(options.run.context);
  if (!(context->names() == measurement.roles.front().gl)) {
    fail("measure session", "the comparison's OpenGL is not the session's: {}", context->names().renderer);
  }
  measurement.one_process = run_one_process(pack, options.run, measurement.requests);
  const std::vector<Comparison> comparisons =
      compare(pack, measurement.requests, {&measurement.roles.front().frames, &measurement.one_process});
  measurement.session = comparisons[0];
  measurement.fallback = comparisons[1];
  const nlohmann::json report = session_report(pack, measurement);
  fmt::print(
      "{} frames, median {:.1f} ms (one process {:.1f} ms); {} of {} identical to the un-culled picture\n",
      measurement.requests.size(), report["frame_ms"]["p50"].get<double>(),
      report["one_process"]["frame_ms"]["p50"].get<double>(), measurement.session.identical_frames,
      measurement.session.frames_compared);
  fmt::print(
      "drawn over visible {:.2f}; deltas save {:.1f} % of ids, {:.2f} bytes an id; {:.2f} Mbit/s (formula "
      "{:.2f})\n",
      measurement.session.culling_efficiency(), report["delta"]["saved_percent"].get<double>(),
      report["delta"]["body_bytes_per_id"].get<double>(), report["mbit_per_s"]["measured"].get<double>(),
      report["mbit_per_s"]["formula"].get<double>());
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
  add_session_flags(*session, *options);
  session->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace triptych
