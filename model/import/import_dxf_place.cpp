// From the blocks of a drawing to meshes and instances. What a block inherits from the insert that places it
// (entities on layer 0, colours "by block") makes a mesh of its own for each different inheritance.
#include "base/one_line.hpp"
#include "model/import/display_color.hpp"
#include "model/import/import_dxf.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <glm/mat4x4.hpp>
#include <tuple>

namespace triptych {

namespace {

constexpr uint32_t layer_zero = 0;
constexpr size_t max_depth = 256;

/// What the content of a block takes over from its insert.
struct Inherited {
  uint32_t layer = layer_zero;
  DxfColor color = 0xffffff;  ///< without by_layer and by_block
  auto operator<=>(const Inherited&) const = default;
};

class Placing {
 public:
  Placing(const DxfDrawing& drawing, const Affine& to_model, FileImport& target)
      : drawing_(drawing), to_model_(to_model), target_(target) {}

  void run() {
    place_model_space();
    for (const DxfInsert& insert : drawing_.model_space.inserts) place_insert(insert, to_model_, {}, no_id);
    for (const auto& [layer, count] : hidden_) {
      const DxfLayer& hidden = drawing_.layers[layer];
      target_.warn(fmt::format("faces and inserts on the layer \"{}\" are not drawn, since it is {}",
                               one_line(hidden.name.substr(0, 60)), hidden.frozen ? "frozen" : "off"),
                   count);
    }
    target_.warn("faces and inserts on further layers that are off or frozen are not drawn",
                 hidden_elsewhere_);
  }

 private:
  /// Counts an insert, skipped ones too, or a further copy of its block.
  bool is_beyond_limit() {
    const uint64_t most = target_.options().max_placements;
    if (++placements_ > most) target_.warn(fmt::format("inserts beyond {} were skipped", most));
    return placements_ > most;
  }

  /// Counts what a layer hides; the first ones by name.
  void count_hidden(uint32_t layer, uint64_t count) {
    constexpr size_t most = 12;
    if (hidden_.size() < most || hidden_.count(layer) > 0) {
      hidden_[layer] += count;
    } else {
      hidden_elsewhere_ += count;
    }
  }

  static uint32_t layer_of(const DxfStyle& style, const Inherited& inherited) {
    return style.layer == layer_zero ? inherited.layer : style.layer;
  }

  DxfColor color_of(const DxfStyle& style, const Inherited& inherited) const {
    if (style.color == dxf_color::by_block) return inherited.color;
    return style.color == dxf_color::by_layer ? drawing_.layers[layer_of(style, inherited)].color
                                              : style.color;
  }

  uint32_t material_of(DxfColor color) {
    if (color == dxf_color::none) return 0;
    const auto [found, added] = materials_.try_emplace(color);
    if (added) found->second = target_.add_material({from_display_color(color)});
    return found->second;
  }

  bool is_hidden(uint32_t layer) const { return drawing_.layers[layer].off || drawing_.layers[layer].frozen; }

  /// Adds the triangles that `wanted` takes as a mesh, with the vertices that they use.
  template <typename Wanted>
  std::optional<uint32_t> add_mesh(const DxfBlock& block, std::string name, const Inherited& inherited,
                                   const Wanted& wanted) {
    Mesh mesh{.name = std::move(name), .positions = {}, .triangles = {}};
    constexpr uint32_t unused = 0xffffffff;
    std::vector<uint32_t> renamed(block.positions.size(), unused);
    for (const DxfTriangle& triangle : block.triangles) {
      const uint32_t layer = layer_of(triangle.style, inherited);
      if (!wanted(layer)) continue;
      Triangle added{{}, material_of(color_of(triangle.style, inherited))};
      for (size_t k = 0; k < 3; ++k) {
        uint32_t& vertex = renamed[triangle.vertices[k]];
        if (vertex == unused) {
          vertex = static_cast<uint32_t>(mesh.positions.size());
          mesh.positions.push_back(block.positions[triangle.vertices[k]]);
        }
        added.vertices[k] = vertex;
      }
      mesh.triangles.push_back(added);
    }
    return target_.add_mesh(std::move(mesh));
  }

  void place_model_space() {
    const DxfBlock& space = drawing_.model_space;
    std::vector<uint64_t> counts(drawing_.layers.size());
    for (const DxfTriangle& triangle : space.triangles) ++counts[triangle.style.layer];
    for (uint32_t layer = 0; layer < counts.size(); ++layer) {
      if (counts[layer] == 0) continue;
      if (is_hidden(layer)) {
        count_hidden(layer, counts[layer]);
        continue;
      }
      if (const auto mesh = add_mesh(space, drawing_.layers[layer].name, {},
                                     [&](uint32_t of_triangle) { return of_triangle == layer; }))
        target_.add_instance(*mesh, to_model_, layer_object(layer));
    }
  }

  std::optional<uint32_t> mesh_of(const DxfBlock& block, const Inherited& inherited) {
    if (block.triangles.empty()) return std::nullopt;
    const auto [inherits, is_new] = inherits_.try_emplace(&block);
    if (is_new) {
      inherits->second =
          std::any_of(block.triangles.begin(), block.triangles.end(), [](const auto& triangle) {
            return triangle.style.layer == layer_zero || triangle.style.color == dxf_color::by_block;
          });
    }
    const auto [found, added] =
        meshes_.try_emplace(std::pair(&block, inherits->second ? inherited : Inherited{}));
    if (added) {
      uint64_t shown = 0;
      found->second = add_mesh(block, block.name, found->first.second, [&](uint32_t layer) {
        if (is_hidden(layer)) count_hidden(layer, 1);
        shown += !is_hidden(layer);
        return !is_hidden(layer);
      });
    }
    return found->second;
  }

  /// What stands in the model space itself: one object for each layer.
  SourceObjectId layer_object(uint32_t layer) {
    const std::string& name = drawing_.layers[layer].name;
    return target_.objects().add({.name = name, .type = "LAYER", .layer = name});
  }

  SourceObjectId insert_object(const DxfInsert& insert, const DxfBlock& block, uint32_t layer,
                               SourceObjectId parent) {
    std::vector<uint32_t> sets;
    if (!insert.attributes.empty()) {
      const auto [found, added] = attribute_sets_.try_emplace(&insert);
      if (added) found->second = target_.objects().add_set("Attributes", insert.attributes);
      sets.push_back(found->second);
    }
    return target_.objects().add(
        {.name = block.name, .type = "INSERT", .layer = drawing_.layers[layer].name, .number = insert.handle},
        parent, sets);
  }

  void place_insert(const DxfInsert& insert, const Affine& outer, const Inherited& inherited,
                    SourceObjectId parent) {
    if (is_beyond_limit()) return;
    const Inherited inner{layer_of(insert.style, inherited), color_of(insert.style, inherited)};
    if (drawing_.layers[inner.layer].frozen) return count_hidden(inner.layer, 1);
    const auto found = drawing_.blocks.find(insert.block);
    if (found == drawing_.blocks.end())
      return target_.warn("inserts of blocks that are not in the file were skipped");
    const DxfBlock& block = found->second;
    if (block.external) {
      return target_.warn(fmt::format("inserts of an external drawing were skipped; import it beside: {}",
                                      one_line(block.name.substr(0, 80))));
    }
    if (std::find(open_.begin(), open_.end(), &block) != open_.end() || open_.size() >= max_depth)
      return target_.warn("inserts within themselves were skipped");
    if (block.triangles.empty() && block.inserts.empty()) return;
    const auto mesh = mesh_of(block, inner);
    const SourceObjectId object = insert_object(insert, block, inner.layer, parent);
    const Affine to_base({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, -block.base);
    for (uint32_t row = 0; row < insert.rows; ++row) {
      for (uint32_t column = 0; column < insert.columns; ++column) {
        if (row + column > 0 && is_beyond_limit()) return;
        Affine at = insert.transform;
        at[3] += insert.column * static_cast<double>(column) + insert.row * static_cast<double>(row);
        const Affine placed = outer * glm::dmat4(at) * glm::dmat4(to_base);
        if (!is_usable(placed[0]) || !is_usable(placed[1]) || !is_usable(placed[2]) ||
            !is_usable(placed[3])) {
          target_.warn("placements were dropped: their transforms are not finite");
          continue;
        }
        if (mesh) target_.add_instance(*mesh, placed, object);
        open_.push_back(&block);
        for (const DxfInsert& nested : block.inserts) place_insert(nested, placed, inner, object);
        open_.pop_back();
      }
    }
  }

  const DxfDrawing& drawing_;
  Affine to_model_;
  FileImport& target_;
  std::map<DxfColor, uint32_t> materials_;
  std::map<const DxfBlock*, bool> inherits_;  ///< whether the mesh depends on the insert
  std::map<std::pair<const DxfBlock*, Inherited>, std::optional<uint32_t>> meshes_;
  std::map<const DxfInsert*, uint32_t> attribute_sets_;
  std::map<uint32_t, uint64_t> hidden_;  ///< faces and inserts by layer
  std::vector<const DxfBlock*> open_;    ///< those that hold what is being placed
  uint64_t hidden_elsewhere_ = 0, placements_ = 0;
};

}  // namespace

void place_dxf(const DxfDrawing& drawing, const Affine& to_model, FileImport& target) {
  Placing(drawing, to_model, target).run();
}

}  // namespace triptych
