// Tessellates an OpenCASCADE document and writes it as a scene stream.
#pragma once

#include "launch/step/step_document.hpp"
#include "model/import/scene_writer.hpp"

#include <Message_ProgressRange.hxx>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace triptych {

/// Counts of what is left out, "<count> <what>" each.
using StepNotes = std::map<std::string, uint64_t>;

/// Every product is one mesh, however often it is placed. chord: how far triangles may lie from surfaces, in
/// the stream's unit; nullopt: a ten-thousandth of the document's longest side. Error (the format) for a
/// document without shapes.
void write_step_scene(const StepDocument& document, std::optional<double> chord, SceneWriter& writer,
                      StepNotes& notes, const Message_ProgressRange& progress);

}  // namespace triptych
