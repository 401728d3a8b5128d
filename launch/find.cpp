#include "launch/answering.hpp"
#include "launch/object_report.hpp"
#include "launch/shown_model.hpp"
#include "measure/json.hpp"
#include "session/open_pack.hpp"

namespace triptych {

namespace {

struct FindCommand {
  ShownModel model;
  std::filesystem::path json;
  std::string text;
};

int run(const FindCommand& command) {
  const Pack pack = open_pack(pack_of(command.model, {command.json}));
  nlohmann::json description = nlohmann::json::object();
  const size_t found = list_objects(pack, command.text, description);
  write_json(command.json, description);
  return found > 0 ? 0 : 1;
}

}  // namespace

void add_find(CLI::App& app, Action& action, int& failed) {
  auto command = std::make_shared<FindCommand>();
  CLI::App* sub = app.add_subcommand("find", "Find objects of the model's files in a pack");
  sub->footer(
      "Exit code 0: objects were found; 1: none; 2: an error.\n"
      "Example: triptych find scene.tpk IfcDoor");
  add_common_flags(*sub, command->json);
  add_one_shown_model(*sub, command->model);
  sub->add_option("word", command->text,
                  "What their name, kind, layer, storey, GUID, number or a property's value holds")
      ->required()
      ->type_name("WORD");
  sub->callback([=, &action, &failed] {
    failed = 2;
    check_shown_model(*sub, command->model);
    action = [=] { return run(*command); };
  });
}

}  // namespace triptych
