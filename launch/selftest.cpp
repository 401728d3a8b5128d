// Checks whether a device behaves, on this machine, as culling requires.
#include "launch/command.hpp"
#include "measure/json.hpp"
#include "raster/certify_raster.hpp"
#include "render/certify_gl.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

int run(const DeviceOptions& options, const std::filesystem::path& json) {
  const ChosenDevice device = choose_device(options);
  const RasterCertificate certificate =
      device.options.kind == DeviceKind::gl ? certify_gl() : certify_raster();
  const DeviceNames& names = device.names;
  fmt::print("{}, {}, version {}\n{} sub-pixel bits, as it says itself\n\n", names.vendor, names.renderer,
             names.version, certificate.claimed_subpixel_bits);
  nlohmann::json findings = nlohmann::json::array();
  for (const RasterFinding& finding : certificate.findings) {
    fmt::print("{:<56} {:>10} {:<10} margin {:<9.3g} {}\n", finding.name, finding.measured, finding.unit,
               finding.margin, finding.holds() ? "holds" : "FAILS");
    findings.push_back({{"name", finding.name},
                        {"value", finding.value},
                        {"margin", finding.margin},
                        {"unit", finding.unit},
                        {"holds", finding.holds()}});
  }
  const std::string& verdict = verdict_name(certificate.verdict());
  fmt::print("\n{}\n", verdict);
  nlohmann::json report = {
      {"verdict", verdict}, {"subpixel_bits", certificate.claimed_subpixel_bits}, {"findings", findings}};
  add_device(report, names);
  write_json(json, report);
  return 0;
}

}  // namespace

void add_selftest(CLI::App& app, Action& action) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* sub =
      app.add_subcommand("selftest", "Check whether the device draws on this machine as culling requires");
  sub->footer("Example: triptych selftest --device cpu");
  add_common_flags(*sub, options->json);
  add_device_flags(*sub, options->device);
  sub->callback([=, &action] { action = [=] { return run(options->device, options->json); }; });
}

}  // namespace triptych
