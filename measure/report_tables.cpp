#include "measure/report_tables.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

namespace {

void add_speed(HtmlTable& table, const ReportEntry* entry, const std::string& name) {
  if (!entry) return;
  const double median = entry->figure("/frame_ms/p50");
  table.rows.push_back({name, grouped(entry->figure("/frames")), grouped(median, 1),
                        grouped(entry->figure("/frame_ms/p95"), 1),
                        median > 0 ? grouped(1000 / median, 1) : "–",
                        grouped(entry->figure("/drawn_triangles/mean")),
                        grouped(entry->figure("/visible/mean"), 1), grouped(entry->figure("/cut/mean"), 1)});
}

void add_delta(HtmlTable& table, const ReportEntry* entry, const std::string& name) {
  if (!entry) return;
  table.rows.push_back({name, grouped(entry->figure("/frames")), grouped(entry->figure("/visible/mean"), 1),
                        grouped(entry->figure("/delta/added_mean"), 2),
                        grouped(entry->figure("/delta/removed_mean"), 2),
                        grouped(entry->figure("/delta/saved_percent"), 1) + "&nbsp;%",
                        grouped(entry->figure("/delta/body_bytes_per_id"), 2)});
}

void add_stages(HtmlTable& table, const ReportEntry& entry, const std::string& at, const std::string& who,
                bool sent) {
  const std::vector<std::pair<std::string, std::string>> stages = {
      {"occlusion_representation", "occlusion representation"},
      {"hardware_cull", "hardware cull"},
      {"render", "render"},
      {"network", "network"},
      {"waiting", "waiting"}};
  for (const auto& [key, name] : stages) {
    if (!sent && (key == "network" || key == "waiting")) continue;
    std::vector<std::string> row = {who + ": " + name};
    for (const char* figure : {"mean", "p50", "p95", "p99", "max"}) {
      row.push_back(grouped(entry.figure(at + "/stages_ms/" + key + "/" + figure), 2));
    }
    table.rows.push_back(row);
  }
}

}  // namespace

HtmlTable model_table(const Report& report) {
  HtmlTable table{{"", ""}, {}};
  const auto add = [&](const std::string& name, const std::string& value) {
    table.rows.push_back({name, value});
  };
  if (const ReportEntry* const sample = report.find("sample")) {
    add("rooms", grouped(sample->figure("/rooms")));
    add("pieces of furniture", grouped(sample->figure("/placements")));
    add("models of furniture", grouped(sample->figure("/furniture_meshes")));
  }
  if (const ReportEntry* const info = report.find("info")) {
    add("triangles, placed", grouped(info->figure("/placed_triangles")));
    add("triangles, unique", grouped(info->figure("/source_triangles")));
    add("objects: initial, partition, clusters, partition",
        grouped(info->figure("/objects/initial")) + ", " + grouped(info->figure("/objects/partition1")) +
            ", " + grouped(info->figure("/objects/clusters")) + ", " +
            grouped(info->figure("/objects/partition2")));
    add("scene nodes, in levels",
        grouped(info->figure("/scene_nodes")) + ", " + grouped(info->figure("/levels")));
    add("drawables", grouped(info->figure("/drawables")));
    add("pack, MB", grouped(info->figure("/pack_bytes") / 1e6, 1));
  }
  if (const ReportEntry* const build = report.find("build")) {
    double seconds = 0;
    for (size_t i = 0; i < build->figures.value("stages", nlohmann::json::array()).size(); ++i) {
      seconds += build->figure(fmt::format("/stages/{}/seconds", i));
    }
    add("build of the pack, seconds", grouped(seconds, 1));
    add("memory of the build, MB", grouped(build->figure("/peak_rss_bytes") / 1e6));
  }
  return table;
}

HtmlTable speed_table(const Report& report) {
  HtmlTable table{{"", "frames", "median ms", "p95 ms", "frames/s (median)", "triangles drawn",
                   "drawables drawn", "of a cut of"},
                  {}};
  add_speed(table, report.find("full_detail"), "frustum at full detail, one process");
  add_speed(table, report.find("one_process"), "one process, 1 pixel");
  add_speed(table, report.find("coarse"), "one process, 8 pixels");
  add_speed(table, report.find("walk"), "three processes, 1 pixel");
  return table;
}

HtmlTable exactness_table(const Report& report) {
  HtmlTable table{{"", "frames compared", "identical", "visible drawables left out", "digest mismatches",
                   "drawn by fallback", "culling efficiency"},
                  {}};
  if (const ReportEntry* const walk = report.find("walk")) {
    table.rows.push_back(
        {"three processes", grouped(walk->figure("/frames_compared")),
         grouped(walk->figure("/identical_frames")), grouped(walk->figure("/missing_drawables")),
         grouped(walk->figure("/digest_mismatches")), grouped(walk->figure("/fallback_frames")),
         grouped(walk->figure("/culling_efficiency"), 2)});
    table.rows.push_back({"one process", grouped(walk->figure("/one_process/frames_compared")),
                          grouped(walk->figure("/one_process/identical_frames")), "–", "–", "–",
                          grouped(walk->figure("/one_process/culling_efficiency"), 2)});
  }
  return table;
}

HtmlTable delta_table(const Report& report) {
  HtmlTable table{
      {"path", "frames", "drawn", "added a frame", "removed a frame", "ids saved", "body bytes an id"}, {}};
  add_delta(table, report.find("walk"), "walk");
  add_delta(table, report.find("fly"), "fly");
  add_delta(table, report.find("spin"), "spin");
  if (!table.rows.empty())
    table.rows.push_back({"the paper", "–", "100 to 4000", "–", "–", "93&nbsp;%", "4"});
  return table;
}

HtmlTable socket_table(const Report& report) {
  HtmlTable table{{"from, to, channel", "bytes a frame"}, {}};
  const ReportEntry* const walk = report.find("walk");
  if (!walk) return table;
  double sum = 0;
  const nlohmann::json sockets = walk->figures.value("bytes_per_frame", nlohmann::json::object());
  for (const auto& [name, bytes] : sockets.items()) {
    if (!bytes.is_number()) continue;
    table.rows.push_back({escape_html(name), grouped(bytes.get<double>(), 1)});
    sum += bytes.get<double>();
  }
  table.rows.push_back({"all", grouped(sum, 1)});
  return table;
}

HtmlTable stages_table(const Report& report) {
  HtmlTable table{{"", "mean", "p50", "p95", "p99", "max"}, {}};
  if (const ReportEntry* const walk = report.find("walk")) {
    add_stages(table, *walk, "", "three processes", true);
    add_stages(table, *walk, "/one_process", "one process", false);
  }
  return table;
}

}  // namespace triptych
