// The tables of a report's page; each has no rows where the report lacks its entries.
#pragma once

#include "report/html.hpp"
#include "report/report.hpp"

namespace triptych {

HtmlTable model_table(const Report& report);
/// Full detail, one process, 8 pixels, three processes.
HtmlTable speed_table(const Report& report);
HtmlTable exactness_table(const Report& report);
/// By path, with the paper's figure as the last row.
HtmlTable delta_table(const Report& report);
/// Bytes per frame beside the paper's formula: socket by socket, by receiver, in total.
HtmlTable socket_table(const Report& report);
/// From a camera's release to its picture, in parts that add up.
HtmlTable latency_table(const Report& report);
/// By packet size, where `measure session --batch` swept over several.
HtmlTable batch_table(const Report& report);
/// What went wrong in sessions, and that they recovered.
HtmlTable faults_table(const Report& report);
/// Each run of frames that a render node drew by itself: why, from when, until when.
HtmlTable mended_table(const Report& report);
HtmlTable stages_table(const Report& report);

}  // namespace triptych
