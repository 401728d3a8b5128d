#include "report/report_tables.hpp"

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

size_t rows_at(const ReportEntry& entry, const std::string& pointer) {
  return entry.figures.value(nlohmann::json::json_pointer(pointer), nlohmann::json::array()).size();
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
      {"path", "frames", "drawn", "added per frame", "removed per frame", "ids saved", "body bytes per id"},
      {}};
  add_delta(table, report.find("walk"), "walk");
  add_delta(table, report.find("fly"), "fly");
  add_delta(table, report.find("spin"), "spin");
  if (!table.rows.empty())
    table.rows.push_back({"the paper", "–", "100 to 4000", "–", "–", "93&nbsp;%", "4"});
  return table;
}

HtmlTable socket_table(const Report& report) {
  HtmlTable table{{"from, to, channel", "bytes per frame", "by the formula", "by the kernel", "sent again",
                   "round trip, ms"},
                  {}};
  const ReportEntry* const walk = report.find("walk");
  if (!walk) return table;
  const std::string at = "/traffic/sockets/";
  for (size_t i = 0; i < rows_at(*walk, "/traffic/sockets"); ++i) {
    const std::string row = at + std::to_string(i);
    table.rows.push_back(
        {escape_html(walk->text(row + "/socket")), grouped(walk->figure(row + "/bytes_per_frame"), 1),
         grouped(walk->figure(row + "/formula_bytes_per_frame"), 1),
         grouped(walk->figure(row + "/kernel_bytes_per_frame"), 1),
         grouped(walk->figure(row + "/retransmissions")), grouped(walk->figure(row + "/round_trip_ms"), 2)});
  }
  for (size_t i = 0; i < rows_at(*walk, "/traffic/receivers"); ++i) {
    const std::string row = "/traffic/receivers/" + std::to_string(i);
    table.rows.push_back({"all to the " + escape_html(walk->text(row + "/receiver")),
                          grouped(walk->figure(row + "/bytes_per_frame"), 1),
                          grouped(walk->figure(row + "/formula_bytes_per_frame"), 1), "–", "–", "–"});
  }
  table.rows.push_back({"all", grouped(walk->figure("/traffic/bytes_per_frame"), 1),
                        grouped(walk->figure("/traffic/formula_bytes_per_frame"), 1),
                        grouped(walk->figure("/traffic/kernel_bytes_per_frame"), 1),
                        grouped(walk->figure("/traffic/retransmissions")), "–"});
  return table;
}

HtmlTable latency_table(const Report& report) {
  HtmlTable table{{"", "mean", "p50", "p95", "p99", "max"}, {}};
  const ReportEntry* const walk = report.find("walk");
  if (!walk) return table;
  const std::vector<std::pair<std::string, std::string>> parts = {
      {"waiting", "waiting: for the switch node, and of that node for packets"},
      {"occlusion_representation", "occlusion representation"},
      {"hardware_cull", "hardware cull"},
      {"network", "network: transfer of the camera and of the sentinel"},
      {"render", "render, after the sentinel was sent"},
      {"remainder", "remainder"},
      {"whole", "camera to image"}};
  for (const auto& [key, name] : parts) {
    std::vector<std::string> row = {name};
    for (const char* figure : {"mean", "p50", "p95", "p99", "max"}) {
      row.push_back(grouped(walk->figure("/latency_ms/" + key + "/" + figure), 2));
    }
    table.rows.push_back(row);
  }
  return table;
}

HtmlTable batch_table(const Report& report) {
  HtmlTable table{{"ids per packet", "bytes per frame", "packets per frame", "camera to image, median ms",
                   "p95 ms", "frame, median ms"},
                  {}};
  for (const ReportEntry& entry : report.entries) {
    const size_t rows = rows_at(entry, "/batches");
    if (rows < 2) continue;  // not a sweep
    for (size_t i = 0; i < rows; ++i) {
      const std::string at = "/batches/" + std::to_string(i);
      table.rows.push_back({grouped(entry.figure(at + "/batch")),
                            grouped(entry.figure(at + "/bytes_per_frame"), 1),
                            grouped(entry.figure(at + "/packets_per_frame"), 2),
                            grouped(entry.figure(at + "/camera_to_image_ms/p50"), 1),
                            grouped(entry.figure(at + "/camera_to_image_ms/p95"), 1),
                            grouped(entry.figure(at + "/frame_ms/p50"), 1)});
    }
  }
  return table;
}

HtmlTable faults_table(const Report& report) {
  HtmlTable table{{"session", "frames", "sets sent again after a wrong digest",
                   "frames drawn by the render node by itself", "roles started again"},
                  {}};
  for (const ReportEntry& entry : report.entries) {
    if (!entry.figures.contains("digest_mismatches") || !entry.figures.contains("fallback_frames")) continue;
    table.rows.push_back({escape_html(entry.name), grouped(entry.figure("/frames")),
                          grouped(entry.figure("/digest_mismatches")),
                          grouped(entry.figure("/fallback_frames")),
                          entry.figures.contains("restarts") ? grouped(entry.figure("/restarts")) : "–"});
  }
  return table;
}

HtmlTable mended_table(const Report& report) {
  HtmlTable table{{"session", "what happened", "at frame", "seconds into the session",
                   "frames drawn by the render node by itself", "for, ms", "all three again at frame"},
                  {}};
  for (const ReportEntry& entry : report.entries) {
    for (size_t i = 0; i < rows_at(entry, "/faults"); ++i) {
      const std::string at = "/faults/" + std::to_string(i);
      const bool back = !entry.figures.at(nlohmann::json::json_pointer(at))
                             .value("back_at_frame", nlohmann::json())
                             .is_null();
      table.rows.push_back({escape_html(entry.name), escape_html(entry.text(at + "/reason")),
                            grouped(entry.figure(at + "/frame")), grouped(entry.figure(at + "/second"), 2),
                            grouped(entry.figure(at + "/frames_alone")),
                            grouped(entry.figure(at + "/alone_ms")),
                            back ? grouped(entry.figure(at + "/back_at_frame")) : "–"});
    }
  }
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
