#include "launch/step/step_document.hpp"

#include "base/error.hpp"

#include <IGESCAFControl_Reader.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_InterfaceModel.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <StepBasic_ConversionBasedUnitAndLengthUnit.hxx>
#include <StepBasic_LengthUnit.hxx>
#include <StepBasic_SiUnitAndLengthUnit.hxx>
#include <TCollection_HAsciiString.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XCAFApp_Application.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <cctype>
#include <fmt/ranges.h>

namespace triptych {

namespace {

bool is_iges(std::string extension) {
  for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return extension == ".igs" || extension == ".iges";
}

/// "StepShape_AdvancedFace" is an AdvancedFace.
std::string kind_of(const opencascade::handle<Standard_Transient>& entity) {
  std::string name = entity->DynamicType()->Name();
  if (const size_t end = name.find('_'); end != std::string::npos) name.erase(0, end + 1);
  return name;
}

void note_failures(const XSControl_WorkSession& session, StepDocument& result) {
  const opencascade::handle<Interface_InterfaceModel> model = session.Model();
  const opencascade::handle<XSControl_TransferReader> transfer = session.TransferReader();
  if (model.IsNull() || transfer.IsNull() || transfer->TransientProcess().IsNull()) return;
  Interface_CheckIterator checks = transfer->TransientProcess()->CheckList(Standard_True);
  for (checks.Start(); checks.More(); checks.Next()) {
    if (!checks.Value()->HasFailed() || checks.Number() <= 0 || checks.Number() > model->NbEntities())
      continue;
    const opencascade::handle<Standard_Transient> entity = model->Value(checks.Number());
    result.failed[kind_of(entity)].emplace_back(model->StringLabel(entity)->ToCString());
  }
}

bool names_length_unit(const Interface_InterfaceModel& model) {
  for (Standard_Integer i = 1; i <= model.NbEntities(); ++i) {
    const opencascade::handle<Standard_Transient> entity = model.Value(i);
    if (entity->IsKind(STANDARD_TYPE(StepBasic_SiUnitAndLengthUnit)) ||
        entity->IsKind(STANDARD_TYPE(StepBasic_ConversionBasedUnitAndLengthUnit)) ||
        entity->IsKind(STANDARD_TYPE(StepBasic_LengthUnit)))
      return true;
  }
  return false;
}

template <typename Reader>
void choose_content(Reader& reader) {
  reader.SetColorMode(Standard_True);
  reader.SetNameMode(Standard_True);
  reader.SetLayerMode(Standard_True);
}

/// What both readers do.
template <typename Reader>
void read(Reader& reader, const std::filesystem::path& file, const Message_ProgressRange& progress,
          StepDocument& result) {
  choose_content(reader);
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) fail(result.format, "does not parse");
  if (!reader.Transfer(result.document, progress))
    fail(result.format, "holds nothing that OpenCASCADE can read");
}

}  // namespace

std::vector<std::string> failed_lines(const StepDocument& document) {
  constexpr size_t max_named = 5;
  std::vector<std::string> lines;
  for (const auto& [kind, entities] : document.failed) {
    const size_t named = std::min(entities.size(), max_named);
    lines.push_back(
        fmt::format("{} {} could not be read: {}{}", entities.size(), kind,
                    fmt::join(entities.begin(), entities.begin() + static_cast<std::ptrdiff_t>(named), ", "),
                    named < entities.size() ? " ..." : ""));
  }
  return lines;
}

StepDocument read_step_document(const std::filesystem::path& file, const std::string& extension,
                                const Message_ProgressRange& progress) {
  StepDocument result;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", result.document);
  if (is_iges(extension)) {
    result.format = "IGES";
    IGESCAFControl_Reader reader;
    read(reader, file, progress, result);
    note_failures(*reader.WS(), result);
    return result;
  }
  result.format = "STEP";
  STEPCAFControl_Reader reader;
  read(reader, file, progress, result);
  const auto& session = *reader.ChangeReader().WS();
  note_failures(session, result);
  result.unit_is_defined = names_length_unit(*session.Model());
  return result;
}

}  // namespace triptych
