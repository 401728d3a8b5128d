#include "launch/build_flags.hpp"
#include "launch/import_flags.hpp"
#include "launch/measure.hpp"
#include "launch/number_flags.hpp"
#include "launch/text_table.hpp"
#include "measure/json.hpp"
#include "measure/light_noise.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct MeasureLightCommand {
  std::vector<std::filesystem::path> inputs;
  ImportOptions import;
  LightOptions light;
  std::vector<uint32_t> samples = {16, 64, 256};
  std::filesystem::path json;
};

int run(const MeasureLightCommand& command) {
  check_are_no_packs(command.inputs);
  check_is_no_model_file({command.json}, command.inputs);
  LightOptions options = command.light;
  options.bake = true;
  const Model model = import_model(command.inputs, command.import);
  const LightNoiseReport report = measure_light_noise(model, options, command.samples);
  const auto bytes = report.light.points * sizeof(VertexLight);
  nlohmann::json rows = nlohmann::json::array();
  std::vector<std::vector<std::string>> lines;
  for (const LightNoise& row : report.rows) {
    rows.push_back({{"samples", row.samples},
                    {"seconds", row.seconds},
                    {"rmse", row.rmse},
                    {"openness_rmse", row.openness_rmse},
                    {"triangles", report.light.refined_triangles},
                    {"bytes", bytes}});
    lines.push_back({in_threes(row.samples), in_threes(row.seconds, 2), fmt::format("{:.4f}", row.rmse),
                     fmt::format("{:.4f}", row.openness_rmse),
                     in_threes(static_cast<double>(report.light.refined_triangles)),
                     in_threes(static_cast<double>(bytes))});
  }
  fmt::print("{}", text_table({"samples", "seconds", "rmse", "openness rmse", "triangles", "bytes"}, lines));
  fmt::print(
      "against {} samples, which took {:.1f} s; 1 is what shows white as white, {:.4g} lx; {} triangles "
      "became {} "
      "in {:.1f} s\n",
      in_threes(report.reference_samples), report.reference_seconds, report.light.white_lux,
      in_threes(static_cast<double>(report.light.triangles)),
      in_threes(static_cast<double>(report.light.refined_triangles)), report.refinement_seconds);
  write_json(command.json, {{"rows", rows},
                            {"reference_samples", report.reference_samples},
                            {"reference_seconds", report.reference_seconds},
                            {"refinement_seconds", report.refinement_seconds},
                            {"bounces", options.bounces},
                            {"points", report.light.points},
                            {"source_triangles", report.light.triangles},
                            {"white_lux", report.light.white_lux}});
  return 0;
}

}  // namespace

void add_measure_light(CLI::App& measure, Action& action) {
  constexpr uint32_t most_samples = 1u << 14, most_bounces = 32;
  auto command = std::make_shared<MeasureLightCommand>();
  CLI::App* sub = measure.add_subcommand(
      "light", "How noisy baked light is by its number of samples, and how long it takes");
  sub->footer("Example: triptych measure light scene.gltf --samples 16,64,256 --json light.json");
  add_common_flags(*sub, command->json);
  sub->add_option("input", command->inputs, "Model files")->required()->type_name("INPUT");
  add_import_flags(*sub, command->import);
  take_list(sub->add_option("--samples", command->samples,
                            "Rays over the hemisphere of each vertex: a row for each"))
      ->check(whole_number(1, most_samples))
      ->default_str("16,64,256")
      ->type_name("N,...");
  sub->add_option("--light-bounces", command->light.bounces, "How often light is reflected between surfaces")
      ->check(whole_number(0, most_bounces))
      ->capture_default_str();
  sub->add_flag("--ambient", command->light.ambient, "Refine for ambient occlusion, too");
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
