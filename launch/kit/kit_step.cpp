#include "launch/kit/kit_step.hpp"

#include "base/error.hpp"
#include "samples/kit/kit_plan.hpp"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <IGESCAFControl_Writer.hxx>
#include <IGESControl_Controller.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <vector>

namespace triptych {

namespace {

constexpr double millimetres = 1000;  ///< a document's unit

gp_Pnt point_of(const KitSolid& solid, const glm::dvec2& corner, double along) {
  const glm::dvec3 point = millimetres * kit_point(solid, corner, along);
  return {point.x, point.y, point.z};
}

TopoDS_Shape prism_of(const KitSolid& solid) {
  BRepBuilderAPI_MakePolygon outline;
  for (const glm::dvec2& corner : solid.outline) outline.Add(point_of(solid, corner, solid.from));
  outline.Close();
  const gp_Vec along(point_of(solid, solid.outline[0], solid.from),
                     point_of(solid, solid.outline[0], solid.to));
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()).Face(), along).Shape();
}

Quantity_Color color_of(const KitSolid& solid) {
  return {solid.colour[0] / 255.0, solid.colour[1] / 255.0, solid.colour[2] / 255.0, Quantity_TOC_sRGB};
}

/// An assembly for each storey.
opencascade::handle<TDocStd_Document> document_of_kit() {
  opencascade::handle<TDocStd_Document> document;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", document);
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto colors = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const TDF_Label kit = shapes->NewShape();
  TDataStd_Name::Set(kit, "kit");
  std::vector<TDF_Label> storeys;
  for (const KitStorey& storey : kit_storeys()) {
    storeys.push_back(shapes->NewShape());
    TDataStd_Name::Set(storeys.back(), storey.name.c_str());
    TDataStd_Name::Set(shapes->AddComponent(kit, storeys.back(), TopLoc_Location()), storey.name.c_str());
  }
  for (const KitSolid& solid : kit_solids()) {
    const TDF_Label part = shapes->AddShape(prism_of(solid), Standard_False);
    TDataStd_Name::Set(part, solid.name.c_str());
    colors->SetColor(part, color_of(solid), XCAFDoc_ColorSurf);
    const TDF_Label placed = shapes->AddComponent(storeys[solid.storey], part, TopLoc_Location());
    TDataStd_Name::Set(placed, solid.name.c_str());
  }
  shapes->UpdateAssemblies();
  return document;
}

bool write_step(const opencascade::handle<TDocStd_Document>& document, const std::filesystem::path& file) {
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.unit", "M");
  STEPCAFControl_Writer writer;
  return writer.Transfer(document, STEPControl_AsIs) && writer.Write(file.c_str()) == IFSelect_RetDone;
}

bool write_iges(const opencascade::handle<TDocStd_Document>& document, const std::filesystem::path& file) {
  IGESControl_Controller::Init();
  Interface_Static::SetCVal("write.iges.unit", "M");
  Interface_Static::SetCVal("write.iges.brep.mode", "BRep");
  IGESCAFControl_Writer writer;
  return writer.Transfer(document) && writer.Write(file.c_str());
}

}  // namespace

bool opencascade_writes(const std::string& format) { return format == "step" || format == "igs"; }

void write_kit_with_opencascade(const std::string& format, const std::filesystem::path& file) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  const auto document = document_of_kit();
  if (!(format == "step" ? write_step(document, file) : write_iges(document, file)))
    fail("OpenCASCADE", "cannot write {}", file.string());
}

}  // namespace triptych
