#include "preprocess/check/check.hpp"

#include "base/error.hpp"
#include "launch/command.hpp"
#include "measure/json.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

int run(const std::filesystem::path& file, const std::filesystem::path& json) {
  const Pack pack(file);
  const CheckReport report = check_pack(pack);
  for (const std::string& message : report.messages) fmt::print("{}\n", message);
  fmt::print(
      "{} drawables checked, {} not; violations: {} bounds, {} boxes, {} monotonicity, {} outsides, {} "
      "checksums\n",
      report.drawables_checked, report.drawables_not_checked, report.bound_violations, report.box_violations,
      report.monotonicity_violations, report.outward_violations, report.checksum_errors);
  write_json(json, {{"drawables_checked", report.drawables_checked},
                    {"drawables_not_checked", report.drawables_not_checked},
                    {"bound_violations", report.bound_violations},
                    {"box_violations", report.box_violations},
                    {"monotonicity_violations", report.monotonicity_violations},
                    {"outward_violations", report.outward_violations},
                    {"checksum_errors", report.checksum_errors},
                    {"bound_over_measured", to_json(report.bound_over_measured)}});
  if (!report.sound()) {
    fail(file.string(), "the pack is not sound: {}",
         report.messages.empty() ? "see above" : report.messages.front());
  }
  return 0;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  auto file = std::make_shared<std::filesystem::path>();
  auto json = std::make_shared<std::filesystem::path>();
  CLI::App* sub = app.add_subcommand("check", "Check whether a pack is sound");
  sub->footer("Example: triptych check scene.tpk");
  add_common_flags(*sub, *json);
  sub->add_option("pack", *file, "The pack")->required()->type_name("FILE.tpk");
  sub->callback([=, &action] { action = [=] { return run(*file, *json); }; });
}

}  // namespace triptych
