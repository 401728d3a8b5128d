#include "launch/command.hpp"
#include "measure/json.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

nlohmann::json vector_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

nlohmann::json describe(const Pack& pack) {
  const Skeleton& skeleton = pack.skeleton();
  const Box box = skeleton.lattice().box(skeleton.scene_nodes[0].box);
  const ImportReport& import = skeleton.import;
  return {{"format_version", pack_format_version},
          {"content_hash", fmt::format("{:016x}", pack.content_hash())},
          {"source_triangles", skeleton.source_triangles},
          {"placed_triangles", skeleton.placed_triangles},
          {"drawables", skeleton.drawables.size()},
          {"scene_nodes", skeleton.scene_nodes.size()},
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
          {"import",
           {{"dropped_triangles", import.dropped_triangles},
            {"welded_vertices", import.welded_vertices},
            {"repaired_edges", import.repaired_edges},
            {"stuck_groups", import.stuck_groups},
            {"warnings", import.warnings}}}};
}

int run(const std::filesystem::path& file, const std::filesystem::path& json) {
  const Pack pack(file);
  const nlohmann::json description = describe(pack);
  for (const auto& [key, value] : description.items()) fmt::print("{:<17} {}\n", key, value.dump());
  write_json(json, description);
  return 0;
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  auto file = std::make_shared<std::filesystem::path>();
  auto json = std::make_shared<std::filesystem::path>();
  CLI::App* sub = app.add_subcommand("info", "What is in a pack");
  sub->footer("Example: triptych info scene.tpk");
  add_common_flags(*sub, *json);
  sub->add_option("pack", *file, "The pack")->required()->type_name("FILE.tpk");
  sub->callback([=, &action] { action = [=] { return run(*file, *json); }; });
}

}  // namespace triptych
