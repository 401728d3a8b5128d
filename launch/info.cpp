#include "base/one_line.hpp"
#include "launch/command.hpp"
#include "launch/file_report.hpp"
#include "launch/object_report.hpp"
#include "launch/solid_report.hpp"
#include "launch/text_table.hpp"
#include "measure/hierarchy_quality.hpp"
#include "measure/json.hpp"
#include "scene/finest_boxes.hpp"
#include "scene/skeleton_memory.hpp"
#include "session/open_pack.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

namespace {

nlohmann::json vector_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Null where the pack does not say.
nlohmann::json build_json(const Pack& pack) {
  const PackOptions options = pack.read_options();
  return options.empty() ? nlohmann::json() : nlohmann::json(options);
}

/// Where on Earth the model stands; null where the pack does not say.
nlohmann::json place_json(const Skeleton& skeleton) {
  if (!skeleton.geo_place) return nullptr;
  const GeoPlace& place = *skeleton.geo_place;
  return {{"latitude", place.latitude},
          {"longitude", place.longitude},
          {"elevation", place.elevation},
          {"north", {place.north.x, place.north.y}}};
}

double bytes_a_drawable(const Skeleton& skeleton, uint64_t bytes) {
  return static_cast<double>(bytes) / static_cast<double>(std::max<size_t>(skeleton.drawables.size(), 1));
}

/// What the skeleton takes in memory.
nlohmann::json memory_json(const Skeleton& skeleton) {
  const uint64_t bytes = skeleton_bytes(skeleton);
  nlohmann::json arrays = nlohmann::json::object();
  for (const ArrayMemory& array : skeleton_memory(skeleton))
    arrays[std::string(array.name)] = {{"count", array.count}, {"bytes", array.bytes}};
  return {{"bytes", bytes}, {"bytes_a_drawable", bytes_a_drawable(skeleton, bytes)}, {"arrays", arrays}};
}

void print_memory(const Skeleton& skeleton) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](std::string_view name, const std::string& count, uint64_t bytes) {
    rows.push_back({std::string(name), count, in_threes(static_cast<double>(bytes)),
                    in_threes(bytes_a_drawable(skeleton, bytes), 1)});
  };
  for (const ArrayMemory& array : skeleton_memory(skeleton)) {
    if (array.bytes > 0) add(array.name, in_threes(static_cast<double>(array.count)), array.bytes);
  }
  add("skeleton", "", skeleton_bytes(skeleton));
  fmt::print("\n{}", text_table({"in memory", "count", "bytes", "bytes a drawable"}, rows));
}

/// All of them, with all of their levels: in the pack, and as a device has them.
nlohmann::json textures_json(const Skeleton& skeleton) {
  uint64_t packed = 0, texels = 0;
  for (const Texture& texture : skeleton.textures) {
    for (uint32_t level = 0; level < texture.levels.size(); ++level) {
      packed += texture.levels[level].size;
      texels += uint64_t{side_at_level(texture.width, level)} * side_at_level(texture.height, level);
    }
  }
  return {{"count", skeleton.textures.size()}, {"pack_bytes", packed}, {"bytes", texels * sizeof(Texel)}};
}

nlohmann::json describe(const Pack& pack) {
  const Skeleton& skeleton = pack.skeleton();
  const Box box = model_box(skeleton);
  return {{"format_version", pack.format_version()},
          {"content_hash", fmt::format("{:016x}", pack.content_hash())},
          {"source_triangles", skeleton.source_triangles},
          {"placed_triangles", skeleton.placed_triangles},
          {"drawables", skeleton.drawables.size()},
          {"scene_nodes", skeleton.scene_nodes.size()},
          {"sub_hierarchies", skeleton.sub_hierarchies},
          {"instances", skeleton.instances.size()},
          {"levels", skeleton.levels()},
          {"chunks", skeleton.chunks.size()},
          {"pack_bytes", pack.size()},
          {"lattice_step", skeleton.lattice().step},
          {"box", {{"min", vector_json(box.lo)}, {"max", vector_json(box.hi)}}},
          {"objects",
           {{"initial", skeleton.objects.initial},
            {"partition1", skeleton.objects.partition1},
            {"clusters", skeleton.objects.clusters},
            {"partition2", skeleton.objects.partition2}}},
          {"effects", skeleton.effects},
          {"textures", textures_json(skeleton)},
          {"place", place_json(skeleton)},
          {"build", build_json(pack)},
          {"import", to_json(skeleton.import)},
          {"skeleton", memory_json(skeleton)},
          {"hierarchy", to_json(hierarchy_quality(skeleton))}};
}

void print_objects(const Skeleton& skeleton) {
  std::vector<std::string> row;
  for (const uint64_t count :
       {skeleton.placed_triangles, skeleton.objects.initial, skeleton.objects.partition1,
        skeleton.objects.clusters, skeleton.objects.partition2})
    row.push_back(in_threes(static_cast<double>(count)));
  fmt::print("\n{}",
             text_table({"polygons", "initial objects", "partition 1", "clusters", "partition 2"}, {row}));
}

void print_hierarchy(const Skeleton& skeleton) {
  const HierarchyQuality quality = hierarchy_quality(skeleton);
  std::vector<std::vector<std::string>> rows;
  for (size_t i = 0; i < quality.levels.size(); ++i) {
    const HierarchyLevel& level = quality.levels[i];
    rows.push_back({std::to_string(i + 1), in_threes(static_cast<double>(level.scene_nodes)),
                    in_threes(static_cast<double>(level.leaves)),
                    in_threes(static_cast<double>(level.drawables)),
                    in_threes(static_cast<double>(level.triangles))});
  }
  fmt::print("\n{}", text_table({"level", "scene nodes", "leaves", "drawables", "triangles"}, rows));
  fmt::print(
      "\ndepth of leaves: mean {:.1f}, largest {:.0f}; balance (lightest child over heaviest): mean "
      "{:.2f}; overlap of siblings: mean {:.1f} % of their parent, 95th percentile {:.1f} %\n",
      quality.depth.mean, quality.depth.max, quality.balance.mean, 100 * quality.overlap.mean,
      100 * quality.overlap.p95);
}

/// A value for people: without quotes and brackets.
std::string in_words(const nlohmann::json& value) {
  if (value.is_string()) return one_line(value.get<std::string>());
  if (value.is_number_unsigned()) return in_threes(value.get<double>());
  if (value.is_null()) return "not said";
  if (!value.is_structured()) return json_text(value);
  if (value.empty()) return "none";
  std::string words;
  for (const auto& [key, part] : value.items()) {
    if (!words.empty()) words += value.is_object() ? ", " : part.is_string() ? "; " : " ";
    if (value.is_object()) words += key + " ";
    words += in_words(part);
  }
  return words;
}

struct InfoCommand {
  ShownModel model;
  std::filesystem::path json;
  bool objects = false;
  std::string find;
};

int run(const InfoCommand& command) {
  const Pack pack = open_pack(pack_of(command.model, {command.json}));
  nlohmann::json description = describe(pack);
  if (command.objects) {
    list_objects(pack, command.find, description);
    list_solids(pack, description);
    write_json(command.json, description);
    return 0;
  }
  for (const auto& [key, value] : description.items()) {
    if (key != "hierarchy" && key != "objects" && key != "skeleton")
      fmt::print("{:<17} {}\n", key, in_words(value));
  }
  print_objects(pack.skeleton());
  print_hierarchy(pack.skeleton());
  print_memory(pack.skeleton());
  write_json(command.json, description);
  return 0;
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  auto command = std::make_shared<InfoCommand>();
  CLI::App* sub = app.add_subcommand("info", "Print what is in a pack");
  sub->footer("Example: triptych info scene.tpk");
  add_common_flags(*sub, command->json);
  add_shown_model(*sub, command->model);
  CLI::Option* objects = sub->add_flag("--objects", command->objects,
                                       "The objects of the model's files: names, kinds, layers, storeys, "
                                       "GUIDs, and how many scene nodes show them");
  sub->add_option("--find", command->find,
                  "Only objects that have this text in one of these, or in the value of a property")
      ->needs(objects)
      ->type_name("TEXT");
  sub->callback([=, &action] {
    check_shown_model(*sub, command->model);
    action = [=] { return run(*command); };
  });
}

}  // namespace triptych
