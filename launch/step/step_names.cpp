#include "launch/step/step_names.hpp"

#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <utility>

namespace triptych {

std::string text_of(const TCollection_ExtendedString& text) {
  const TCollection_AsciiString utf8(text);  // converts
  return {utf8.ToCString(), static_cast<size_t>(utf8.Length())};
}

std::string name_of(const TDF_Label& label) {
  opencascade::handle<TDataStd_Name> name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return "";
  std::string text = text_of(name->Get());
  return text.starts_with("=>[") ? "" : text;
}

std::string name_of(const XCAFPrs_DocumentNode& node) {
  std::string name = name_of(node.Label);
  return name.empty() ? name_of(node.RefLabel) : name;
}

std::vector<Body> named_bodies_of(const TDF_Label& product) {
  std::vector<Body> bodies;
  TDF_LabelSequence labels;
  XCAFDoc_ShapeTool::GetSubShapes(product, labels);
  for (const TDF_Label& label : labels) {
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label);
    const bool is_body = !shape.IsNull() && shape.ShapeType() <= TopAbs_SHELL;
    if (std::string name = name_of(label); is_body && !name.empty())
      bodies.push_back({std::move(name), shape});
  }
  if (bodies.size() < 2) bodies.clear();
  return bodies;
}

}  // namespace triptych
