// Reads a STEP or IGES file into OpenCASCADE's document: assemblies, names, colours, layers.
#pragma once

#include <Message_ProgressRange.hxx>
#include <TDocStd_Document.hxx>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace triptych {

struct StepDocument {
  std::string format;  ///< "STEP" or "IGES"
  opencascade::handle<TDocStd_Document> document;
  /// Whether the file names its unit, and the document is in millimetres; otherwise it is in that unit.
  bool unit_is_defined = true;
  /// What could not be read: entities by kind, as the file numbers them.
  std::map<std::string, std::vector<std::string>> failed;
};

/// What could not be read, a line for each kind: "2 AdvancedFace could not be read: #12, #15".
std::vector<std::string> failed_lines(const StepDocument& document);

/// By the extension: IGES for .igs and .iges, otherwise STEP. Error (the format) for one that cannot be read.
StepDocument read_step_document(const std::filesystem::path& file, const std::string& extension,
                                const Message_ProgressRange& progress);

}  // namespace triptych
