#include "preprocess/check/check.hpp"

#include "base/error.hpp"
#include "launch/command.hpp"
#include "launch/solid_report.hpp"
#include "launch/text_table.hpp"
#include "measure/json.hpp"
#include "session/open_pack.hpp"

#include <cstdio>
#include <fmt/core.h>

namespace triptych {

namespace {

struct CheckCommand {
  ShownModel model;
  std::filesystem::path json;
  bool quick = false;
};

/// Error (pack) with the first of the messages, unless all is well.
void expect_sound(const Pack& pack, bool sound, const std::vector<std::string>& messages) {
  if (!sound)
    fail(pack.name(), "the pack is not sound: {}", messages.empty() ? "see above" : messages.front());
}

void check_quickly(const Pack& pack, const CheckOptions& options, const std::filesystem::path& json) {
  const BytesReport report = check_bytes(pack, options);
  fmt::print(
      "{} bytes of {} chunks and all other sections compared with their checksums: {} differ; boxes, errors "
      "and distances were not checked\n",
      in_threes(static_cast<double>(report.bytes)), report.chunks, report.checksum_errors);
  write_json(json, {{"quick", true},
                    {"checked_bytes", report.bytes},
                    {"checked_chunks", report.chunks},
                    {"checksum_errors", report.checksum_errors}});
  expect_sound(pack, report.checksum_errors == 0, report.messages);
}

void check_all(const Pack& pack, const CheckOptions& options, const std::filesystem::path& json) {
  const CheckReport report = check_pack(pack, options);
  fmt::print(
      "{} drawables checked, {} not; violations: {} bounds, {} boxes, {} monotonicity, {} outsides, {} "
      "left out, {} checksums\n",
      report.drawables_checked, report.drawables_not_checked, report.bound_violations, report.box_violations,
      report.monotonicity_violations, report.outward_violations, report.seen_violations,
      report.checksum_errors);
  nlohmann::json described = {{"drawables_checked", report.drawables_checked},
                              {"drawables_not_checked", report.drawables_not_checked},
                              {"bound_violations", report.bound_violations},
                              {"box_violations", report.box_violations},
                              {"monotonicity_violations", report.monotonicity_violations},
                              {"outward_violations", report.outward_violations},
                              {"seen_violations", report.seen_violations},
                              {"checksum_errors", report.checksum_errors},
                              {"bound_over_measured", to_json(report.bound_over_measured)}};
  list_solids(pack, described);
  write_json(json, described);
  expect_sound(pack, report.sound(), report.messages);
}

int run(const CheckCommand& command) {
  const Pack pack = open_pack(pack_of(command.model, {command.json}));
  CheckOptions options;
  options.found = [](const std::string& message) {
    fmt::print("{}\n", message);
    std::fflush(stdout);  // it is found long before the check ends
  };
  (command.quick ? check_quickly : check_all)(pack, options, command.json);
  return 0;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  auto command = std::make_shared<CheckCommand>();
  CLI::App* sub = app.add_subcommand("check", "Check whether a pack is sound");
  sub->footer("Example: triptych check scene.tpk --quick");
  add_common_flags(*sub, command->json);
  add_shown_model(*sub, command->model);
  sub->add_flag("--quick", command->quick,
                "Only compare all bytes with their checksums, as fast as the file can be read");
  sub->callback([=, &action] {
    check_shown_model(*sub, command->model);
    action = [=] { return run(*command); };
  });
}

}  // namespace triptych
