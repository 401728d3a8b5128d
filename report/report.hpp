// The input of a report: what the commands of a run wrote as JSON, each with its command.
#pragma once

#include "base/machine.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace triptych {

struct ReportEntry {
  std::string name;            ///< its name in the page: "walk", "one_process" …
  std::string command;         ///< as it was typed
  std::filesystem::path file;  ///< the JSON file of its figures
  nlohmann::json figures;

  /// The number at a JSON pointer such as "/frame_ms/p50". Error (place: the file) where there is none.
  double figure(const std::string& pointer) const;
  /// The text, or the numbers, at a JSON pointer; the same Error.
  std::string text(const std::string& pointer) const;
  std::vector<double> numbers(const std::string& pointer) const;
};

struct ReportPicture {
  std::string file;  ///< relative to the page
  std::string caption, command;
  std::filesystem::path source;  ///< where it lies
};

/// Where a report comes from.
struct ReportOrigin {
  std::string date, version;  ///< as people read them
  Machine machine;
};

struct Report {
  std::string title;
  std::string note;                      ///< an introduction for the reader; may be empty
  bool held_to_exactness_alone = false;  ///< the other goals are not meant for this run
  std::vector<ReportEntry> entries;
  std::vector<ReportPicture> pictures;
  ReportOrigin origin;

  /// The entry of that name, or none.
  const ReportEntry* find(const std::string& name) const;
};

/// Reads a manifest {"title", "note", "held_to", "entries": [{"name", "command", "json"}], "pictures":
/// [{"file", "caption", "command", "path", "frame"}]} and the JSON files that it names, relative to it.
/// "held_to" is "everything", the default, or "exactness". Where a picture names its path and its frame, the
/// caption says where the eye is. Error for a file that is missing or broken, a key that is not known, a name
/// used twice, and a picture that is not there.
Report load_report(const std::filesystem::path& manifest);

/// Gives the pictures names of the page's own, "report-pictures/3-000060.png", so that its folder can be
/// moved.
void name_pictures_beside_page(Report& report);
/// Copies them from where they lie into the page's folder, under these names. Error if one cannot be copied.
void copy_pictures(const Report& report, const std::filesystem::path& folder);

}  // namespace triptych
