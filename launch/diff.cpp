#include "base/one_line.hpp"
#include "launch/answering.hpp"
#include "launch/build_flags.hpp"
#include "launch/built_otherwise.hpp"
#include "launch/text_table.hpp"
#include "measure/difference/difference_model.hpp"
#include "measure/json.hpp"

#include <array>
#include <fmt/core.h>
#include <map>

namespace triptych {

namespace {

struct DiffCommand {
  std::filesystem::path before, after, output, json;
};

/// What is counted, in the order of the table's columns.
struct Counted {
  const char* name;
  bool (*holds)(const ObjectChange&);
};
constexpr std::array<Counted, 7> counted = {
    {{"added", [](const ObjectChange& change) { return change.added(); }},
     {"removed", [](const ObjectChange& change) { return change.removed(); }},
     {"moved", [](const ObjectChange& change) { return change.shape.moved; }},
     {"recoloured", [](const ObjectChange& change) { return change.shape.recolored; }},
     {"reshaped", [](const ObjectChange& change) { return change.shape.reshaped; }},
     {"told_otherwise", [](const ObjectChange& change) { return !change.told.empty(); }},
     {"unchanged", [](const ObjectChange& change) { return !change.differs(); }}}};
using Counts = std::array<uint64_t, counted.size()>;

/// The packs and what is different, with what tables and JSON ask for.
struct Difference {
  const Revision& before;
  const Revision& after;
  PackDifference found;

  const Revision& shown_in(const ObjectChange& change) const { return change.removed() ? before : after; }
  SourceObjectId id_of(const ObjectChange& change) const {
    return change.removed() ? change.object.before : change.object.after;
  }
  bool is_named(const ObjectChange& change) const {
    return id_of(change) != shown_in(change).shapes.nameless();
  }
  /// A text of the object's; of what is in no object, nothing.
  std::string text_of(const ObjectChange& change, uint32_t SourceObject::*member) const {
    if (!is_named(change)) return "";
    const SourceObjects& source = shown_in(change).source();
    return std::string(source.texts[source.objects[id_of(change)].*member]);
  }
  std::string path_of(const ObjectChange& change) const {
    return is_named(change) ? shown_in(change).source().path_of(id_of(change)) : "";
  }
};

void count(const ObjectChange& change, Counts& counts) {
  for (size_t i = 0; i < counted.size(); ++i) counts[i] += counted[i].holds(change);
}

Counts count_all(const Difference& difference) {
  Counts counts{};
  for (const ObjectChange& change : difference.found.objects) count(change, counts);
  return counts;
}

std::map<std::string, Counts> count_by_type(const Difference& difference) {
  std::map<std::string, Counts> types;
  for (const ObjectChange& change : difference.found.objects)
    count(change, types[difference.text_of(change, &SourceObject::type)]);
  return types;
}

nlohmann::json to_json(const Counts& counts) {
  nlohmann::json json;
  for (size_t i = 0; i < counted.size(); ++i) json[counted[i].name] = counts[i];
  return json;
}

nlohmann::json to_json(const Difference& difference, const ObjectChange& change) {
  nlohmann::json json = {{"change", words_of(change)}};
  for (const auto& [key, member] : {std::pair{"name", &SourceObject::name},
                                    {"type", &SourceObject::type},
                                    {"guid", &SourceObject::guid},
                                    {"storey", &SourceObject::storey}}) {
    if (const std::string text = difference.text_of(change, member); !text.empty()) json[key] = text;
  }
  if (const std::string path = difference.path_of(change); !path.empty()) json["path"] = path;
  const auto add_side = [&](const char* key, const Revision& revision, SourceObjectId id) {
    if (id == no_id) return;
    const Box box = revision.shapes.box_of(id);
    nlohmann::json& side = json[key] = {{"triangles", revision.shapes.triangles_of(id)}};
    if (id != revision.shapes.nameless()) side["id"] = id;
    if (!box.empty()) {
      side["box"] = {{"min", {box.lo.x, box.lo.y, box.lo.z}}, {"max", {box.hi.x, box.hi.y, box.hi.z}}};
    }
  };
  add_side("before", difference.before, change.object.before);
  add_side("after", difference.after, change.object.after);
  if (change.shape.moved) {
    const glm::dvec3& offset = change.shape.offset;
    json["offset"] = {offset.x, offset.y, offset.z};
    json["turned_degrees"] = change.shape.turned;
  }
  for (const ToldChange& told : change.told)
    json["told"].push_back({{"what", told.what}, {"before", told.before}, {"after", told.after}});
  return json;
}

nlohmann::json report_json(const Difference& difference) {
  nlohmann::json types = nlohmann::json::object(), objects = nlohmann::json::array();
  for (const auto& [type, counts] : count_by_type(difference)) types[type] = to_json(counts);
  for (const ObjectChange& change : difference.found.objects) {
    if (change.differs()) objects.push_back(to_json(difference, change));
  }
  return {{"equal", difference.found.equal()},
          {"built_otherwise", to_json(built_otherwise(difference.before.pack.read_options(),
                                                      difference.after.pack.read_options()))},
          {"counts", to_json(count_all(difference))},
          {"types", types},
          {"objects", objects}};
}

std::vector<std::string> row_of(const std::string& name, const Counts& counts) {
  std::vector<std::string> row = {name};
  for (const uint64_t number : counts) row.push_back(in_threes(static_cast<double>(number)));
  return row;
}

/// How an object changed, with figures.
std::string sentence_of(const ObjectChange& change) {
  std::string words = words_of(change);
  if (change.shape.moved) {
    words += fmt::format(" by {:.6g} units", glm::length(change.shape.offset));
    if (change.shape.turned > 1e-3) words += fmt::format(", turned by {:.4g} degrees", change.shape.turned);
  }
  for (size_t i = 0; i < change.told.size() && i < 3; ++i) {
    const ToldChange& told = change.told[i];
    words += fmt::format("; {}: \"{}\" -> \"{}\"", told.what, told.before, told.after);
  }
  if (change.told.size() > 3) words += fmt::format("; and {} more", change.told.size() - 3);
  return words;
}

std::string title_of(const Difference& difference, const ObjectChange& change) {
  if (!difference.is_named(change)) return "what belongs to no object";
  const std::string path = difference.path_of(change);
  const std::string guid = difference.text_of(change, &SourceObject::guid);
  return (path.empty() ? "" : path + " / ") + difference.text_of(change, &SourceObject::name) +
         (guid.empty() ? "" : " " + guid);
}

void print(const Difference& difference) {
  constexpr size_t most = 40;
  size_t listed = 0, left_out = 0;
  for (const ObjectChange& change : difference.found.objects) {
    if (!change.differs()) continue;
    if (++listed > most) {
      ++left_out;
      continue;
    }
    fmt::print("{}: {}\n", one_line(title_of(difference, change)), one_line(sentence_of(change)));
  }
  if (left_out > 0) fmt::print("and {} more, all of which --json FILE has\n", left_out);
  std::vector<std::string> head = {"type"};
  for (const Counted& column : counted) head.emplace_back(column.name);
  head[6] = "told otherwise";
  std::vector<std::vector<std::string>> rows;
  for (const auto& [type, counts] : count_by_type(difference)) rows.push_back(row_of(one_line(type), counts));
  if (rows.size() != 1) rows.push_back(row_of("all", count_all(difference)));
  fmt::print("{}{}", listed > 0 ? "\n" : "", text_table(head, rows));
  fmt::print("{}", told(built_otherwise(difference.before.pack.read_options(),
                                        difference.after.pack.read_options())));
  fmt::print("\nthe packs hold {}\n", difference.found.equal() ? "the same model" : "different models");
}

void write_pack(const Difference& difference, const std::filesystem::path& output) {
  Model model = difference_model(difference.before, difference.after, difference.found);
  BuildOptions options;
  options.said = build_words(BuildFlags{});
  build_pack(std::move(model), options, output);
}

int run(const DiffCommand& command) {
  if (!command.output.empty()) check_may_become_pack(command.output);
  const Revision before(command.before), after(command.after);
  const Difference difference{before, after, compare_packs(before, after)};
  print(difference);
  write_json(command.json, report_json(difference));
  if (!command.output.empty()) write_pack(difference, command.output);
  return difference.found.equal() ? 0 : 1;
}

}  // namespace

void add_diff(CLI::App& app, Action& action, int& failed) {
  auto command = std::make_shared<DiffCommand>();
  CLI::App* sub = app.add_subcommand("diff", "Compare the packs of two revisions of a model");
  sub->footer(
      "Exit code 0: the same model, however it was built; 1: something changed; 2: an error.\n"
      "Example: triptych diff monday.tpk friday.tpk -o changes.tpk");
  add_common_flags(*sub, command->json);
  sub->add_option("before", command->before, "The older pack")->required()->type_name("FILE.tpk");
  sub->add_option("after", command->after, "The newer pack")->required()->type_name("FILE.tpk");
  sub->add_option("-o,--output", command->output,
                  "Write both as one pack: what was added green, removed red, changed yellow, the rest grey")
      ->type_name("FILE.tpk");
  sub->callback([command, &action, &failed] {
    failed = 2;
    action = [command] { return run(*command); };
  });
}

}  // namespace triptych
