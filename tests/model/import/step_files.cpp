#include "step_files.hpp"

#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <IGESCAFControl_Writer.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

namespace triptych::test {

namespace {

Quantity_Color display_color(double red, double green, double blue) {
  return {red, green, blue, Quantity_TOC_sRGB};
}

TopLoc_Location along_x(double distance) {
  gp_Trsf transform;
  transform.SetTranslation(gp_Vec(distance, 0, 0));
  return TopLoc_Location(transform);
}

double height_of(const TopoDS_Shape& face) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  return properties.CentreOfMass().Z();
}

void be_quiet() { Message::DefaultMessenger()->ChangePrinters().Clear(); }

}  // namespace

void write_step_assembly(const std::filesystem::path& file, const std::string& schema) {
  be_quiet();
  opencascade::handle<TDocStd_Document> document;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", document);
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto colors = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(10, 20, 30).Shape();
  const TDF_Label block_label = shapes->AddShape(block, Standard_False);
  TDataStd_Name::Set(block_label, "Block");
  colors->SetColor(block_label, display_color(0, 0, 1), XCAFDoc_ColorSurf);
  for (TopExp_Explorer face(block, TopAbs_FACE); face.More(); face.Next()) {
    if (height_of(face.Current()) > 29)
      colors->SetColor(shapes->AddSubShape(block_label, face.Current()), display_color(1, 0, 0),
                       XCAFDoc_ColorSurf);
  }
  const TDF_Label plate = shapes->AddShape(BRepPrimAPI_MakeBox(5, 5, 5).Shape(), Standard_False);
  TDataStd_Name::Set(plate, "Plate");
  const TDF_Label frame = shapes->NewShape();
  TDataStd_Name::Set(frame, "Frame");
  for (const double x : {0.0, 100.0, 200.0}) shapes->AddComponent(frame, block_label, along_x(x));
  shapes->AddComponent(frame, plate, along_x(300));
  colors->SetColor(shapes->AddComponent(frame, plate, along_x(400)), display_color(0, 1, 0),
                   XCAFDoc_ColorSurf);
  shapes->UpdateAssemblies();
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.schema", schema.c_str());
  Interface_Static::SetCVal("write.step.unit", "MM");
  STEPCAFControl_Writer writer;
  writer.Transfer(document, STEPControl_AsIs);
  writer.Write(file.c_str());
}

void write_step_coloured_assembly(const std::filesystem::path& file) {
  be_quiet();
  opencascade::handle<TDocStd_Document> document;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", document);
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto colors = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const TDF_Label plain = shapes->AddShape(BRepPrimAPI_MakeBox(10, 10, 10).Shape(), Standard_False);
  const TDF_Label blue = shapes->AddShape(BRepPrimAPI_MakeBox(10, 10, 5).Shape(), Standard_False);
  colors->SetColor(blue, display_color(0, 0, 1), XCAFDoc_ColorSurf);
  const TDF_Label pair = shapes->NewShape(), whole = shapes->NewShape();
  shapes->AddComponent(pair, plain, along_x(0));
  shapes->AddComponent(pair, blue, along_x(20));
  shapes->AddComponent(whole, pair, along_x(0));
  colors->SetColor(shapes->AddComponent(whole, pair, along_x(100)), display_color(0, 1, 0),
                   XCAFDoc_ColorSurf);
  shapes->UpdateAssemblies();
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.unit", "MM");
  STEPCAFControl_Writer writer;
  writer.Transfer(document, STEPControl_AsIs);
  writer.Write(file.c_str());
}

void write_step_cylinder(const std::filesystem::path& file, const std::string& unit) {
  be_quiet();
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.unit", unit.c_str());
  STEPControl_Writer writer;
  writer.Transfer(BRepPrimAPI_MakeCylinder(50, 100).Shape(), STEPControl_AsIs);
  writer.Write(file.c_str());
}

void write_iges_groups(const std::filesystem::path& file, const std::string& third) {
  be_quiet();
  opencascade::handle<TDocStd_Document> document;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", document);
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto colors = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const TDF_Label pair = shapes->NewShape(), whole = shapes->NewShape();
  TDataStd_Name::Set(pair, "Pair");
  TDataStd_Name::Set(whole, "Whole");
  const auto add_cube = [&](const TDF_Label& group, const std::string& name, double x,
                            const Quantity_Color& color) {
    const TDF_Label label =
        shapes->AddShape(BRepPrimAPI_MakeBox(gp_Pnt(x, 0, 0), 10, 10, 10).Shape(), Standard_False);
    if (!name.empty()) TDataStd_Name::Set(label, name.c_str());
    colors->SetColor(label, color, XCAFDoc_ColorSurf);
    const TDF_Label placed = shapes->AddComponent(group, label, TopLoc_Location());
    if (!name.empty()) TDataStd_Name::Set(placed, name.c_str());
  };
  add_cube(pair, "Left", 0, display_color(1, 0, 0));
  add_cube(pair, "Right", 20, display_color(0, 0, 1));
  shapes->AddComponent(whole, pair, TopLoc_Location());
  add_cube(whole, third, 40, display_color(0, 1, 0));
  shapes->UpdateAssemblies();
  IGESControl_Controller::Init();
  Interface_Static::SetCVal("write.iges.brep.mode", "BRep");
  IGESCAFControl_Writer writer;
  writer.Transfer(document);
  writer.Write(file.c_str());
}

void write_iges_block(const std::filesystem::path& file, const std::string& unit) {
  be_quiet();
  IGESControl_Controller::Init();
  IGESControl_Writer writer(unit.c_str(), 1);  // 1: as boundary representation
  writer.AddShape(BRepPrimAPI_MakeBox(10, 20, 30).Shape());
  writer.Write(file.c_str());
}

}  // namespace triptych::test
