// DXF, the drawing exchange format of AutoCAD: its sections, tables and blocks, read from front to back.
#include "model/import/import_dxf.hpp"

#include "base/error.hpp"

#include <algorithm>

namespace triptych {

namespace {

class DrawingReader {
 public:
  DrawingReader(DxfReader& reader, FileImport& target) : reader_(reader), target_(target) {}

  DxfDrawing read() {
    bool ended = false, any = false;
    while (!ended && advance()) {
      any = true;
      if (record_.type == "EOF") ended = true;
      if (record_.type != "SECTION") continue;
      const std::string_view name = record_.text(2);
      if (name == "HEADER") {
        read_header();
      } else if (name == "TABLES") {
        read_tables();
      } else if (name == "BLOCKS") {
        read_blocks();
      } else if (name == "ENTITIES") {
        read_entities(drawing_.model_space, "ENDSEC");
      }
    }
    if (!any) fail(target_.place(), "is no DXF file: it holds no group codes");
    if (!ended && drawing_.model_space.triangles.empty() && drawing_.model_space.inserts.empty())
      fail(target_.place(), "the DXF file ends too soon, and holds no surface");
    if (!ended) target_.remark("the file has no end; what stands before was read");
    target_.warn(fmt::format("{}s that are no group code were skipped", reader_.unit_of_place()),
                 reader_.skipped_lines());
    return std::move(drawing_);
  }

 private:
  bool advance() {
    if (kept_) {
      kept_ = false;
      return true;
    }
    return reader_.next(record_);
  }

  /// Each variable is a group 9 with its values behind it.
  void read_header() {
    bool units = false;
    for (const DxfGroup& group : record_.groups) {
      if (group.code == 9) units = group.text == "$INSUNITS";
      if (units && group.code == 70)
        drawing_.units = static_cast<int64_t>(std::clamp(group.number, 0.0, 1e3));
    }
  }

  void read_tables() {
    while (advance() && record_.type != "ENDSEC" && record_.type != "EOF") {
      if (record_.type == "LAYER") read_layer();
    }
  }

  void read_layer() {
    constexpr int64_t frozen = 1;
    if (record_.text(2).empty()) return;
    DxfLayer& layer = drawing_.layers[drawing_.layer_number(record_.text(2))];
    layer.name = record_.text(2);
    layer.frozen = (record_.integer(70) & frozen) != 0;
    layer.off = record_.integer(62) < 0;
    const DxfColor color = dxf_color::of_record(record_);
    layer.color = color == dxf_color::by_layer || color == dxf_color::by_block ? dxf_color::none : color;
  }

  void read_blocks() {
    constexpr int64_t external = 4, overlay = 8;
    while (advance() && record_.type != "ENDSEC" && record_.type != "EOF") {
      if (record_.type != "BLOCK") continue;
      const std::string name(record_.text(2));
      DxfBlock& block = drawing_.blocks[dxf_lower_case(name)];
      block = {};
      block.name = name;
      block.base = {record_.number(10), record_.number(20), record_.number(30)};
      block.external = (record_.integer(70) & (external | overlay)) != 0;
      read_entities(block, "ENDBLK");
    }
  }

  /// Reads entities up to the end of a block or section, or of the file.
  void read_entities(DxfBlock& block, std::string_view end) {
    DxfSurfaces surfaces(drawing_, block, target_);
    size_t inserts = 0;  // before the last entity: attributes belong to an insert that stands before them
    while (advance()) {
      if (record_.type == end) return;
      if (record_.type == "ENDSEC" || record_.type == "EOF" || record_.type == "SECTION") {
        kept_ = true;
        return;
      }
      if (record_.type == "ATTRIB" && inserts < block.inserts.size())
        block.inserts.back().attributes.emplace_back(record_.text(2), record_.text(1));
      if (record_.type == "SEQEND" || record_.type == "VERTEX" || record_.type == "ATTRIB") continue;
      inserts = block.inserts.size();
      const DxfRecord entity = std::move(record_);
      record_ = {};
      vertices_.clear();
      if (entity.type == "POLYLINE") read_vertices();
      add_dxf_entity(entity, vertices_, surfaces);
    }
  }

  void read_vertices() {
    while (advance()) {
      if (record_.type == "SEQEND") return;
      if (record_.type != "VERTEX") {
        kept_ = true;
        return;
      }
      vertices_.push_back(std::move(record_));
      record_ = {};
    }
  }

  DxfReader& reader_;
  FileImport& target_;
  DxfDrawing drawing_;
  DxfRecord record_;
  bool kept_ = false;  ///< whether the record is to be read again
  std::vector<DxfRecord> vertices_;
};

/// Metres of a drawing unit ($INSUNITS); nothing where the file does not say.
std::optional<double> metres_of(int64_t units) {
  static constexpr std::array<double, 25> metres = {0,
                                                    0.0254,
                                                    0.3048,
                                                    1609.344,
                                                    0.001,
                                                    0.01,
                                                    1,
                                                    1000,
                                                    2.54e-8,
                                                    2.54e-5,
                                                    0.9144,
                                                    1e-10,
                                                    1e-9,
                                                    1e-6,
                                                    0.1,
                                                    10,
                                                    100,
                                                    1e9,
                                                    1.495978707e11,
                                                    9.4607304725808e15,
                                                    3.0856775814914e16,
                                                    1200.0 / 3937,
                                                    100.0 / 3937,
                                                    3600.0 / 3937,
                                                    6336000.0 / 3937};
  if (units < 1 || units >= static_cast<int64_t>(metres.size())) return std::nullopt;
  return metres[static_cast<size_t>(units)];
}

}  // namespace

void import_dxf(FileImport& target) {
  DxfReader reader(target.content());
  const DxfDrawing drawing = DrawingReader(reader, target).read();
  target.says_up(UpAxis::z);
  const auto metres = metres_of(drawing.units);
  double scale = 1;
  if (metres && target.options().unit) {
    target.remark(
        "the drawing says its unit ($INSUNITS), which is often that of a template; --unit was applied");
  } else if (metres) {
    scale = *metres;
    target.says_unit(std::nullopt);
  }
  const Affine to_model({scale, 0, 0}, {0, 0, -scale}, {0, scale, 0}, glm::dvec3(0));
  place_dxf(drawing, to_model, target);
}

}  // namespace triptych
