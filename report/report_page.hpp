// A report as one HTML page and as one JSON object.
#pragma once

#include "report/report.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace triptych {

/// The page, self-contained except for the pictures: targets, pictures, tables and charts of the entries that
/// the report has, each with the commands that printed its figures. Error for an entry that lacks a figure
/// which it must have.
std::string report_page(const Report& report);

/// {"title", "note", "all_met", "targets": [{what, value, limit, relation, met, entries}], "entries": [{name,
/// command, figures}], "pictures": [{file, caption, command}]}.
nlohmann::json report_json(const Report& report);

}  // namespace triptych
