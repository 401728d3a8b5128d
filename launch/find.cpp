#include "launch/command.hpp"
#include "launch/object_report.hpp"
#include "launch/shown_model.hpp"
#include "measure/json.hpp"

namespace triptych {

namespace {

struct FindCommand {
  ShownModel model;
  std::filesystem::path json;
  std::string text;
};

int run(const FindCommand& command) {
  const Pack pack(pack_of(command.model, {command.json}));
  nlohmann::json description = nlohmann::json::object();
  list_objects(pack, command.text, description);
  write_json(command.json, description);
  return 0;
}

}  // namespace

void add_find(CLI::App& app, Action& action) {
  auto command = std::make_shared<FindCommand>();
  CLI::App* sub = app.add_subcommand("find", "Find objects of the model's files in a pack");
  sub->footer("Example: triptych find scene.tpk IfcDoor");
  add_common_flags(*sub, command->json);
  add_one_shown_model(*sub, command->model);
  sub->add_option("word", command->text,
                  "What their name, kind, layer, storey, GUID, number or a property's value holds")
      ->required()
      ->type_name("WORD");
  sub->callback([=, &action] {
    check_shown_model(*sub, command->model);
    action = [=] { return run(*command); };
  });
}

}  // namespace triptych
