#include "report/report_page.hpp"

#include "report/chart.hpp"
#include "report/goals.hpp"
#include "report/html.hpp"
#include "report/report_tables.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

namespace {

using Names = std::vector<std::string>;

/// The commands of these entries, to be put under a table or chart.
std::string commands(const Report& report, const Names& names) {
  std::string html;
  for (const ReportEntry& entry : report.entries) {
    if (std::find(names.begin(), names.end(), entry.name) != names.end()) {
      html += "<code>" + escape_html(entry.command) + "</code>";
    }
  }
  return html.empty() ? html : "<p class=\"from\">Printed by" + html + "</p>\n";
}

std::string targets_section(const Report& report) {
  const std::vector<Goal> targets = judge(report);
  if (targets.empty()) return "";
  HtmlTable table{{"target", "outcome"}, {}};
  Names names;
  for (const Goal& target : targets) {
    table.rows.push_back({escape_html(target.what), fmt::format("<span class=\"{}\">{}</span>",
                                                                !target.held   ? "quiet"
                                                                : target.met() ? "met"
                                                                               : "missed",
                                                                escape_html(target.verdict()))});
    names.insert(names.end(), target.entries.begin(), target.entries.end());
  }
  const auto held =
      std::count_if(targets.begin(), targets.end(), [](const Goal& target) { return target.held; });
  const auto met = std::count_if(targets.begin(), targets.end(),
                                 [](const Goal& target) { return target.held && target.met(); });
  const auto others = static_cast<std::ptrdiff_t>(targets.size()) - held;
  return fmt::format("<h2>Targets: {} of {} met{}</h2>\n", met, held,
                     others > 0 ? fmt::format(", {} not held to", others) : "") +
         to_html(table) + commands(report, names);
}

std::string pictures_section(const Report& report) {
  if (report.pictures.empty()) return "";
  std::string html = "<h2>Pictures</h2>\n<div class=\"pictures\">\n";
  Names from;
  for (const ReportPicture& picture : report.pictures) {
    html += fmt::format(
        "<figure><img src=\"{0}\" alt=\"{1}\" loading=\"lazy\"><figcaption>{1}</figcaption></figure>\n",
        escape_html(picture.file), escape_html(picture.caption));
    if (std::find(from.begin(), from.end(), picture.command) == from.end()) from.push_back(picture.command);
  }
  html += "</div>\n<p class=\"from\">Drawn by";
  for (const std::string& command : from) html += "<code>" + escape_html(command) + "</code>";
  return html + "</p>\n";
}

std::string chart_figure(const LineChart& chart, const std::string& caption) {
  return "<figure><div class=\"chart\">" + chart_svg(chart) + "</div><figcaption>" + escape_html(caption) +
         "</figcaption></figure>\n";
}

std::string time_chart(const Report& report) {
  const ReportEntry* const walk = report.find("walk");
  const ReportEntry* const full = report.find("full_detail");
  if (!walk) return "";
  std::string caption = "Frame time along the walk.";
  if (full)
    caption +=
        fmt::format(" The frustum at full detail takes {:.0f} ms (median).", full->figure("/frame_ms/p50"));
  return chart_figure({.unit = "ms per frame",
                       .series = {{"three processes", walk->numbers("/series/frame_ms")},
                                  {"one process", walk->numbers("/one_process/series/frame_ms")}}},
                      caption);
}

std::string visibility_charts(const Report& report) {
  const ReportEntry* const walk = report.find("walk");
  if (!walk) return "";
  return chart_figure({.unit = "drawables",
                       .series = {{"in the cut", walk->numbers("/series/cut")},
                                  {"drawn", walk->numbers("/series/visible")}},
                       .logarithmic = true},
                      "Drawables in the view frustum, and those that the culling lets through; each line of "
                      "the grid is ten "
                      "times the one below.") +
         chart_figure({.unit = "ids",
                       .series = {{"drawn", walk->numbers("/series/visible")},
                                  {"changed, and therefore sent", walk->numbers("/series/changed")}}},
                      "What is drawn, and how much of it changes from one frame to the next.");
}

std::string section(const Report& report, const std::string& title, const std::string& note,
                    const HtmlTable& table, const Names& names, const std::string& after = "") {
  if (table.rows.empty()) return "";
  return "<h2>" + title + "</h2>\n" + (note.empty() ? "" : "<p>" + note + "</p>\n") + to_html(table) + after +
         commands(report, names);
}

std::string command_list(const Report& report) {
  std::string html = "<h2>Every command</h2>\n<ol>\n";
  for (const ReportEntry& entry : report.entries)
    html += "<li><code>" + escape_html(entry.command) + "</code></li>\n";
  return html + "</ol>\n<p class=\"quiet\">All figures of these commands are in report.json.</p>\n";
}

std::string bandwidth_note(const Report& report) {
  const ReportEntry* const walk = report.find("walk");
  if (!walk) return "";
  return fmt::format(
      "On the walk the session sent {:.2f} Mbit/s at {:.1f} frames per second; the paper's formula, 8nf + "
      "nhf/b + 216f + 3hf bytes with headers of 50 bytes and 100 ids per packet, gives {:.2f}. The paper "
      "expects at most 8.3 Mbit/s and saves 93&nbsp;% by deltas on average.",
      walk->figure("/mbit_per_s/measured"), 1000 / std::max(1e-9, walk->figure("/frame_ms/mean")),
      walk->figure("/mbit_per_s/formula"));
}

std::string traffic_note(const Report& report) {
  const ReportEntry* const walk = report.find("walk");
  if (!walk) return "";
  return fmt::format(
      "Headers and bodies of messages, beside the paper’s formula for the ids that change and TCP’s payload "
      "as the kernel counts it. The formula’s third camera is the render node’s own, which is not sent. "
      "Bodies of deltas take {:.1f}&nbsp;% of the paper’s 4 bytes per id. All that was sent, cameras and "
      "digests included, is {:.1f}&nbsp;% of what the formula takes to send every visible id each frame, and "
      "{:.0f}&nbsp;% of what it takes for changes alone.",
      100 * walk->figure("/traffic/share_of_4_bytes_per_id/bodies"),
      100 * walk->figure("/traffic/share_of_formula_whole_sets"),
      100 * walk->figure("/traffic/share_of_formula"));
}

std::string latency_note(const Report& report) {
  const ReportEntry* const walk = report.find("walk");
  if (!walk) return "";
  const double whole = walk->figure("/latency_ms/whole/mean");
  return fmt::format(
      "The time from a camera to its picture, in milliseconds, over the {:.0f} frames that all three roles "
      "drew together, except the first. The parts follow each other; the remainder is {:.2f}&nbsp;% of the "
      "whole.",
      walk->figure("/latency_ms/frames"),
      whole > 0 ? 100 * walk->figure("/latency_ms/remainder/mean") / whole : 0.0);
}

Names entries_with(const Report& report, const std::string& key) {
  Names names;
  for (const ReportEntry& entry : report.entries) {
    if (entry.figures.contains(key)) names.push_back(entry.name);
  }
  return names;
}

std::string stages_note(const Report& report) {
  const ReportEntry* const walk = report.find("walk");
  if (!walk) return "";
  return fmt::format(
      "Milliseconds by the wall clock, each stage up to its <code>glFinish</code>; in the session three "
      "processes share this machine's cores. Timed one at a time, the stages predict {:.1f} frames per "
      "second on three machines, without the network: a prediction, not a measurement. The paper calls 20 "
      "interactive.",
      walk->figure("/predicted_fps_three_machines"));
}

/// What drew the pictures.
std::string device_in_words(const ReportEntry& walk) {
  if (walk.text("/device") == "cpu")
    return "Drawn by the program itself, on the device cpu, without a graphics card";
  return walk.text("/gl/renderer") + ", " + walk.text("/gl/version");
}

/// When, where and by what the report was made.
std::string origin_in_words(const ReportOrigin& origin) {
  const Machine& machine = origin.machine;
  return fmt::format("Made on {} on {}, {} core{}, {:.1f} GiB of memory, by triptych {}", origin.date,
                     machine.processor.empty() ? "an unnamed processor" : machine.processor, machine.cores,
                     machine.cores == 1 ? "" : "s", static_cast<double>(machine.memory_bytes) / 0x1p30,
                     origin.version);
}

}  // namespace

std::string report_page(const Report& report) {
  const ReportEntry* const walk = report.find("walk");
  std::string body = "<h1>" + escape_html(report.title) + "</h1>\n";
  if (walk) {
    body += fmt::format(
        "<p>Three processes, one picture: {} frames at {}, {} of them compared with the un-culled picture "
        "of the same cut, {} identical.</p>\n",
        grouped(walk->figure("/frames")), escape_html(walk->text("/size")),
        grouped(walk->figure("/frames_compared")), grouped(walk->figure("/identical_frames")));
    body += "<p class=\"quiet\">" + escape_html(device_in_words(*walk)) + "</p>\n";
  }
  body += "<p class=\"quiet\">" + escape_html(origin_in_words(report.origin)) + "</p>\n";
  if (!report.note.empty()) body += "<p>" + escape_html(report.note) + "</p>\n";
  body += targets_section(report) + pictures_section(report);
  body += section(report, "The model", "", model_table(report), {"sample", "build", "info"});
  body += section(report, "Speed", "Means unless stated otherwise.", speed_table(report),
                  {"full_detail", "one_process", "coarse", "walk"}, time_chart(report));
  body += section(report, "Exactness and culling",
                  "A frame counts as identical where every pixel is that of the un-culled picture. "
                  "Culling efficiency: drawables drawn for each one that owns a pixel of the item buffer; "
                  "1 is perfect.",
                  exactness_table(report), {"walk"}, visibility_charts(report));
  body += section(report, "What deltas save", bandwidth_note(report), delta_table(report),
                  {"walk", "fly", "spin"});
  body += section(report, "Traffic", traffic_note(report), socket_table(report), {"walk"});
  body += section(report, "Packets",
                  "Smaller packets let receivers begin earlier and cost more bytes (§6.1–6.2 of the paper).",
                  batch_table(report), entries_with(report, "batches"));
  body += section(report, "From camera to image", latency_note(report), latency_table(report), {"walk"});
  const HtmlTable mended = mended_table(report);
  body += section(report, "Faults and recovery",
                  "What a session lost, and when it had recovered; its pictures are correct meanwhile.",
                  faults_table(report), entries_with(report, "fallback_frames"),
                  mended.rows.empty() ? "" : to_html(mended));
  body += section(report, "Stages", stages_note(report), stages_table(report), {"walk"});
  return html_page(report.title, body + command_list(report));
}

nlohmann::json report_json(const Report& report) {
  nlohmann::json targets = nlohmann::json::array(), entries = targets, pictures = targets;
  bool all_met = true;
  for (const Goal& target : judge(report)) {
    all_met = all_met && (target.met() || !target.held);
    targets.push_back({{"what", target.what},
                       {"value", target.value},
                       {"limit", target.limit},
                       {"relation", target.at_least ? "at least" : "at most"},
                       {"held", target.held},
                       {"met", target.met()},
                       {"entries", target.entries}});
  }
  for (const ReportEntry& entry : report.entries) {
    entries.push_back({{"name", entry.name}, {"command", entry.command}, {"figures", entry.figures}});
  }
  for (const ReportPicture& picture : report.pictures) {
    pictures.push_back({{"file", picture.file}, {"caption", picture.caption}, {"command", picture.command}});
  }
  const nlohmann::json origin = {{"date", report.origin.date},
                                 {"processor", report.origin.machine.processor},
                                 {"cores", report.origin.machine.cores},
                                 {"memory_bytes", report.origin.machine.memory_bytes},
                                 {"version", report.origin.version}};
  return {{"title", report.title}, {"note", report.note}, {"made", origin},      {"all_met", all_met},
          {"targets", targets},    {"entries", entries},  {"pictures", pictures}};
}

}  // namespace triptych
