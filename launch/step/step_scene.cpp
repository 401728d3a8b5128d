#include "launch/step/step_scene.hpp"

#include "base/error.hpp"
#include "launch/step/step_names.hpp"

#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Message_ProgressScope.hxx>
#include <Quantity_ColorRGBA.hxx>
#include <RWMesh_FaceIterator.hxx>
#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDF_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XCAFPrs_DocumentExplorer.hxx>
#include <algorithm>
#include <array>
#include <cmath>

namespace triptych {

namespace {

constexpr double metres_per_millimetre = 0.001, size_per_chord = 10'000;
constexpr double max_turn = 0.5;  ///< radians between neighbouring triangles, where the chord allows more

std::string entry_of(const TDF_Label& label) {
  TCollection_AsciiString entry;
  TDF_Tool::Entry(label, entry);
  return entry.ToCString();
}

Affine affine_of(const gp_Trsf& transform, double scale) {
  Affine result;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) result[column][row] = scale * transform.Value(row + 1, column + 1);
  }
  return result;
}

/// Collects a product's faces, those of one material together.
class Faces {
 public:
  void add(const RWMesh_FaceIterator& face, uint32_t material) {
    const auto first = static_cast<uint32_t>(positions_.size());
    for (Standard_Integer i = face.NodeLower(); i <= face.NodeUpper(); ++i) {
      const gp_Pnt point = face.NodeTransformed(i);
      positions_.emplace_back(point.X(), point.Y(), point.Z());
    }
    auto& indices = by_material_[material];
    for (Standard_Integer i = face.ElemLower(); i <= face.ElemUpper(); ++i) {
      const Poly_Triangle triangle = face.TriangleOriented(i);
      for (int k = 1; k <= 3; ++k)
        indices.push_back(first + static_cast<uint32_t>(triangle.Value(k) - face.NodeLower()));
    }
  }

  /// Nullopt without triangles.
  std::optional<uint32_t> write(SceneWriter& writer, const std::string& name) const {
    std::vector<uint32_t> indices;
    std::vector<ScenePart> parts;
    for (const auto& [material, own] : by_material_) {
      if (own.empty()) continue;
      parts.push_back({static_cast<uint32_t>(own.size() / 3), material});
      indices.insert(indices.end(), own.begin(), own.end());
    }
    if (parts.empty()) return std::nullopt;
    return writer.mesh(name, positions_, indices, parts);
  }

 private:
  std::vector<glm::dvec3> positions_;
  std::map<uint32_t, std::vector<uint32_t>> by_material_;
};

class StepScene {
 public:
  StepScene(const StepDocument& source, SceneWriter& writer, StepNotes& notes)
      : source_(source),
        document_(source.document),
        layers_(XCAFDoc_DocumentTool::LayerTool(document_->Main())),
        writer_(writer),
        notes_(notes),
        unit_(source.unit_is_defined ? metres_per_millimetre : 1) {}

  void write(std::optional<double> chord, const Message_ProgressRange& range) {
    deflection_ = chord ? *chord / unit_ : longest_side() / size_per_chord;
    XCAFPrs_DocumentExplorer explorer(document_, XCAFPrs_DocumentExplorerFlags_OnlyLeafNodes);
    std::vector<Leaf> leaves;
    for (; explorer.More(); explorer.Next()) leaves.push_back({explorer.Current(), path_of(explorer)});
    Message_ProgressScope progress(range, "tessellating", static_cast<double>(leaves.size()));
    for (const Leaf& leaf : leaves) {
      place(leaf);
      progress.Next();
    }
  }

 private:
  struct Part {
    uint32_t mesh = 0;
    std::string body;  ///< its name; empty for the product's other faces
  };
  struct Leaf {
    XCAFPrs_DocumentNode node;
    std::string path;  ///< the names of the assemblies that it is in
  };

  static std::string path_of(const XCAFPrs_DocumentExplorer& explorer) {
    std::string path;
    for (Standard_Integer depth = 0; depth < explorer.CurrentDepth(); ++depth)
      path += (depth > 0 ? "/" : "") + name_of(explorer.Current(depth).RefLabel);
    return path;
  }

  double longest_side() const {
    TDF_LabelSequence roots;
    XCAFDoc_DocumentTool::ShapeTool(document_->Main())->GetFreeShapes(roots);
    Bnd_Box box;
    for (const TDF_Label& root : roots) BRepBndLib::Add(XCAFDoc_ShapeTool::GetShape(root), box, false);
    if (box.IsVoid()) fail_empty("holds no shapes");
    std::array<double, 3> low{}, high{};
    box.Get(low[0], low[1], low[2], high[0], high[1], high[2]);
    double longest = 0;
    for (size_t i = 0; i < 3; ++i) longest = std::max(longest, high[i] - low[i]);
    if (!(longest > 0 && longest < 1e50)) fail_empty("holds no shapes with an extent that can be used");
    return longest;
  }

  [[noreturn]] void fail_empty(const std::string& what) const {
    const auto failed = failed_lines(source_);
    fail(source_.format, "{}{}{}", what, failed.empty() ? "" : ": ", failed.empty() ? "" : failed.front());
  }

  void place(const Leaf& leaf) {
    if (!leaf.node.Style.IsVisible()) {
      ++notes_["hidden parts are not drawn"];
      return;
    }
    const auto [known, is_new] = parts_.try_emplace(entry_of(leaf.node.RefLabel));
    if (is_new) known->second = parts_of(leaf.node.RefLabel);
    for (const Part& part : known->second) {
      SceneInstance instance;
      instance.mesh = part.mesh;
      if (leaf.node.Style.IsSetColorSurf()) instance.material = material(leaf.node.Style.GetColorSurfRGBA());
      instance.object = object(leaf, part.body);
      instance.transform = affine_of(leaf.node.Location.Transformation(), unit_);
      writer_.instance(instance);
    }
  }

  /// A product's mesh, or one for each of its named bodies and one for what is in none of them.
  std::vector<Part> parts_of(const TDF_Label& label) {
    const std::string name = name_of(label);
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label);
    const std::vector<Body> bodies = named_bodies_of(label);
    TopTools_DataMapOfShapeInteger body_of;  // of faces, from 1
    for (size_t i = 0; i < bodies.size(); ++i) {
      for (TopExp_Explorer face(bodies[i].shape, TopAbs_FACE); face.More(); face.Next())
        body_of.Bind(face.Current(), static_cast<Standard_Integer>(i + 1));
    }
    std::vector<Faces> faces(bodies.size() + 1);
    uint64_t face_count = 0, without_triangles = 0;
    try {
      BRepMesh_IncrementalMesh(shape, deflection_, Standard_False, max_turn, Standard_True);
      for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next()) {
        TopLoc_Location location;
        ++face_count;
        const auto triangles = BRep_Tool::Triangulation(TopoDS::Face(face.Current()), location);
        without_triangles += triangles.IsNull() || triangles->NbTriangles() == 0;
      }
      for (RWMesh_FaceIterator face(label, TopLoc_Location(), Standard_True); face.More(); face.Next()) {
        const Standard_Integer* const body = body_of.Seek(face.Face());
        if (!face.IsEmptyMesh())
          faces[body ? static_cast<size_t>(*body) : 0].add(
              face, face.HasFaceColor() ? material(face.FaceColor()) : no_record);
      }
      BRepTools::Clean(shape);
    } catch (const Standard_OutOfMemory&) {
      throw;
    } catch (const Standard_Failure& failure) {
      ++notes_[fmt::format("parts were left out, which OpenCASCADE could not tessellate, as \"{}\": {}", name,
                           failure.GetMessageString())];
      return {};
    }
    if (without_triangles > 0)
      notes_[fmt::format("faces of part \"{}\" could not be tessellated", name)] += without_triangles;
    if (face_count == 0) ++notes_["parts without faces (curves, points) were skipped"];
    std::vector<Part> parts;
    for (size_t i = 0; i < faces.size(); ++i) {
      const std::string body = i > 0 ? bodies[i - 1].name : "";
      if (const auto mesh = faces[i].write(writer_, i > 0 ? body : name)) parts.push_back({*mesh, body});
    }
    return parts;
  }

  uint32_t material(const Quantity_ColorRGBA& color) {
    Standard_Real red = 0, green = 0, blue = 0;
    color.GetRGB().Values(red, green, blue, Quantity_TOC_sRGB);
    const std::array<float, 4> key = {static_cast<float>(red), static_cast<float>(green),
                                      static_cast<float>(blue), color.Alpha()};
    const auto [known, is_new] = materials_.try_emplace(key);
    if (is_new) known->second = writer_.material({key[0], key[1], key[2], key[3]});
    return known->second;
  }

  /// body: its name; empty for all of the product.
  uint32_t object(const Leaf& leaf, const std::string& body) {
    SceneObject object;
    object.id = leaf.node.Id.ToCString();
    object.name = body.empty() ? name_of(leaf.node) : body;
    object.type = name_of(leaf.node.RefLabel);
    opencascade::handle<TColStd_HSequenceOfExtendedString> layers = new TColStd_HSequenceOfExtendedString;
    if (layers_->GetLayers(leaf.node.RefLabel, layers) && !layers->IsEmpty())
      object.layer = text_of(layers->First());
    std::string path = leaf.path;
    if (!body.empty()) path += (path.empty() ? "" : "/") + name_of(leaf.node);
    if (!path.empty()) object.property_sets.push_back(writer_.property_set({"Assembly", {{"Path", path}}}));
    return writer_.object(object);
  }

  const StepDocument& source_;
  opencascade::handle<TDocStd_Document> document_;
  opencascade::handle<XCAFDoc_LayerTool> layers_;
  SceneWriter& writer_;
  StepNotes& notes_;
  double unit_, deflection_ = 0;                    ///< stream units for one of the document; document units
  std::map<std::string, std::vector<Part>> parts_;  ///< by the product's label
  std::map<std::array<float, 4>, uint32_t> materials_;
};

}  // namespace

void write_step_scene(const StepDocument& document, std::optional<double> chord, SceneWriter& writer,
                      StepNotes& notes, const Message_ProgressRange& progress) {
  StepScene(document, writer, notes).write(chord, progress);
}

}  // namespace triptych
