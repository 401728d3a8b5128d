// The inner seams of the DXF importer: what a drawing holds, in its own units and axes (z up), in double.
#pragma once

#include "model/import/import_dxf_reader.hpp"
#include "model/import/import_file.hpp"
#include "scene/affine.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace triptych {

/// A colour of 24 bits, 0xRRGGBB, or where it comes from.
using DxfColor = uint32_t;
namespace dxf_color {
constexpr DxfColor by_layer = 0x1000000, by_block = 0x2000000;
constexpr DxfColor none = 0x3000000;  ///< of a layer that is not defined: the default material
/// Of AutoCAD's colour index, 1 to 255.
DxfColor of_index(int64_t index);
/// Of an entity or layer: true colour (420) comes before the index (62).
DxfColor of_record(const DxfRecord& record);
}  // namespace dxf_color

struct DxfLayer {
  std::string name;
  DxfColor color = dxf_color::none;
  bool off = false, frozen = false;
};

/// Layer and colour of an entity.
struct DxfStyle {
  uint32_t layer = 0;  ///< DxfDrawing::layers
  DxfColor color = dxf_color::by_layer;
  auto operator<=>(const DxfStyle&) const = default;
};

struct DxfTriangle {
  std::array<uint32_t, 3> vertices;
  DxfStyle style;
};

/// A placement of a block, as often as its array says.
struct DxfInsert {
  std::string block;             ///< in lower case
  Affine transform{1};           ///< of the block's base point and axes
  glm::dvec3 column{0}, row{0};  ///< from one copy to the next
  uint32_t columns = 1, rows = 1;
  DxfStyle style;
  std::string handle;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< tags and values of its ATTRIBs
};

/// What a block, or the model space, holds.
struct DxfBlock {
  std::string name;
  glm::dvec3 base{0};
  bool external = false;  ///< another file's content
  std::vector<glm::dvec3> positions;
  std::vector<DxfTriangle> triangles;
  std::vector<DxfInsert> inserts;
};

struct DxfDrawing {
  std::vector<DxfLayer> layers = {{.name = "0"}};
  std::map<std::string, uint32_t> layer_numbers = {{"0", 0}};  ///< names in lower case
  std::map<std::string, DxfBlock> blocks;                      ///< names in lower case
  DxfBlock model_space;
  int64_t units = 0;  ///< $INSUNITS

  uint32_t layer_number(std::string_view name);
};

std::string dxf_lower_case(std::string_view name);

/// The axes of an entity whose coordinates are relative to its extrusion direction (DXF Reference, "Arbitrary
/// Axis Algorithm"); the identity where there is none.
Affine dxf_object_axes(const DxfRecord& record);

/// Collects the faces of one block.
class DxfSurfaces {
 public:
  DxfSurfaces(DxfDrawing& drawing, DxfBlock& block, FileImport& target)
      : drawing_(drawing), block_(block), target_(target) {}
  /// Layer and colour that a record gives; what it does not give is that of `otherwise`.
  DxfStyle style_of(const DxfRecord& record, const DxfStyle& otherwise = {});
  DxfBlock& block() { return block_; }
  FileImport& target() { return target_; }

  uint32_t add_vertex(const glm::dvec3& position);
  /// A face of any number of corners, one after the other the same left out; fewer than three are counted.
  void add_face(std::span<const uint32_t> corners, const DxfStyle& style);
  void add_face(std::span<const glm::dvec3> corners, const DxfStyle& style);

 private:
  DxfDrawing& drawing_;
  DxfBlock& block_;
  FileImport& target_;
  std::vector<uint32_t> kept_;
  std::vector<glm::dvec3> corners_;
  std::vector<std::array<uint32_t, 3>> cut_;
};

/// Adds what an entity shows as a surface: faces, solids, meshes, what has a thickness or a width; inserts
/// too. `vertices`: the records between a POLYLINE and its end. Everything else is counted with its kind.
void add_dxf_entity(const DxfRecord& entity, std::span<const DxfRecord> vertices, DxfSurfaces& surfaces);

/// POLYLINE as a polygon mesh or a polyface mesh; false if it is a curve.
bool add_dxf_polyline_mesh(const DxfRecord& entity, std::span<const DxfRecord> vertices,
                           const DxfStyle& style, DxfSurfaces& surfaces);
/// LINE, CIRCLE, ARC, LWPOLYLINE and POLYLINE of a thickness or width; false if it has neither.
bool add_dxf_curve(const DxfRecord& entity, std::span<const DxfRecord> vertices, const DxfStyle& style,
                   DxfSurfaces& surfaces);

/// Adds the drawing to the model: a mesh for each layer of the model space and for each block, and an
/// instance for each place. `to_model`: from the drawing's unit and axes.
void place_dxf(const DxfDrawing& drawing, const Affine& to_model, FileImport& target);

}  // namespace triptych
