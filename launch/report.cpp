#include "base/file.hpp"
#include "launch/command.hpp"
#include "launch/named_files.hpp"
#include "launch/version.hpp"
#include "measure/json.hpp"
#include "report/goals.hpp"
#include "report/report_page.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct ReportCommand {
  std::filesystem::path manifest, output, json;
};

int run(const ReportCommand& command) {
  Report report = load_report(command.manifest);
  report.origin = {.date = date_now(), .version = version_and_commit(), .machine = this_machine()};
  name_pictures_beside_page(report);
  // Everything is made before anything is written: if a figure is missing, no page is left.
  const std::string page = report_page(report);
  const nlohmann::json merged = report_json(report);
  std::vector<std::filesystem::path> sources = {command.manifest};
  for (const ReportEntry& entry : report.entries) sources.push_back(entry.file);
  for (const ReportPicture& picture : report.pictures) sources.push_back(picture.source);
  for (const char* name : {"report.html", "report.json"})
    check_is_none_of(command.output / name, sources, "what the report is made from");
  check_is_none_of(command.json, sources, "what the report is made from");
  make_folder(command.output);
  copy_pictures(report, command.output);
  write_file(command.output / "report.html", page);
  write_json(command.output / "report.json", merged);
  write_json(command.json, merged);
  for (const Goal& target : judge(report)) fmt::print("{}: {}\n", target.what, target.verdict());
  fmt::print("{}\n", (command.output / "report.html").string());
  return 0;
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
  auto command = std::make_shared<ReportCommand>();
  CLI::App* sub =
      app.add_subcommand("report", "A page of what other commands measured, with targets and charts");
  sub->footer(
      "Example: triptych report manifest.json -o .   (the pictures and JSON files that it names lie beside "
      "it)");
  add_common_flags(*sub, command->json);
  sub->add_option("manifest", command->manifest, "The list of JSON files and pictures, with their commands")
      ->required()
      ->type_name("FILE.json");
  sub->add_option("-o,--output", command->output, "Folder for report.html and report.json")
      ->required()
      ->type_name("DIR");
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
