// 3MF: an archive with model parts, whose build places objects and whose objects place others.
#include "model/import/import_3mf.hpp"

#include "base/error.hpp"
#include "base/one_line.hpp"
#include "model/import/display_color.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <glm/mat4x4.hpp>

namespace triptych {

namespace {

constexpr size_t max_depth = 256;

class ArchiveImport {
 public:
  explicit ArchiveImport(FileImport& target) : target_(target), archive_(target.content()) {}

  void run() {
    const std::string root = root_part();
    const ThreeMfPart* part = part_named(root);
    if (!part) fail(target_.place(), "holds no model part (\"3D/3dmodel.model\")");
    const double metres = part->metres;
    // Units in files always are those of the root part.
    to_model_ = Affine({metres, 0, 0}, {0, 0, -metres}, {0, metres, 0}, glm::dvec3(0));
    target_.says_up(UpAxis::z);
    target_.says_unit(metres == 1        ? std::optional(LengthUnit::metre)
                      : metres == 0.01   ? std::optional(LengthUnit::centimetre)
                      : metres == 0.001  ? std::optional(LengthUnit::millimetre)
                      : metres == 0.0254 ? std::optional(LengthUnit::inch)
                      : metres == 0.3048 ? std::optional(LengthUnit::foot)
                                         : std::nullopt);
    std::vector<ThreeMfUse> items = part->items;
    if (items.empty()) {
      target_.remark("the build places nothing; every object that no other one holds is drawn where it is");
      items = loose_objects(*part);
    }
    for (const ThreeMfUse& item : items) place(root, item, to_model_, no_id);
  }

 private:
  /// What the archive's relationships name as its model, or what is usual.
  std::string root_part() {
    if (const std::string* relations = archive_.find("_rels/.rels")) {
      const auto source = archive_.read(*relations, target_.options());
      std::string text(source->size(), ' ');
      SourceReader(source).read(0, std::as_writable_bytes(std::span(text)));
      for (size_t at = text.find("<Relationship "); at != std::string::npos;
           at = text.find("<Relationship ", at + 1)) {
        const std::string element = text.substr(at, text.find('>', at) - at);
        if (element.find("/3dmodel\"") == std::string::npos && element.find("/3dmodel'") == std::string::npos)
          continue;
        const size_t name = element.find("Target=");
        if (name == std::string::npos || name + 8 > element.size()) continue;
        const size_t end = element.find(element[name + 7], name + 8);
        if (end != std::string::npos) return element.substr(name + 8, end - name - 8);
      }
    }
    for (const std::string& member : archive_.members()) {
      if (member.ends_with("3dmodel.model")) return member;
    }
    for (const std::string& member : archive_.members()) {
      if (member.ends_with(".model")) return member;
    }
    return "";
  }

  const ThreeMfPart* part_named(std::string name) {
    if (name.starts_with('/')) name.erase(0, 1);
    const auto known = parts_.find(name);
    if (known != parts_.end()) return &known->second;
    const std::string* member = archive_.find(name);
    if (!member) return nullptr;
    return &parts_.emplace(name, parse_3mf_part(archive_.read(*member, target_.options()), target_))
                .first->second;
  }

  static std::vector<ThreeMfUse> loose_objects(const ThreeMfPart& part) {
    std::vector<ThreeMfUse> loose;
    for (const auto& [id, object] : part.objects) {
      const bool held =
          std::any_of(part.objects.begin(), part.objects.end(), [&, number = id](const auto& other) {
            const auto& components = other.second.components;
            return std::any_of(components.begin(), components.end(), [&](const ThreeMfUse& use) {
              return use.part.empty() && use.object == number;
            });
          });
      if (!held) loose.push_back({"", id, Affine(1), "", ""});
    }
    return loose;
  }

  uint32_t material_of(const ThreeMfPart& part, const std::optional<ThreeMfColor>& color) {
    if (!color) return 0;
    const auto group = part.colors.find(color->group);
    if (group == part.colors.end() || color->index >= group->second.size()) return 0;
    const uint32_t value = group->second[color->index];
    const auto [found, added] = materials_.try_emplace(value);
    if (added) found->second = target_.add_material({from_display_color(value)});
    return found->second;
  }

  std::optional<uint32_t> mesh_of(const ThreeMfPart& part, const ThreeMfObject& object) {
    const auto [found, added] = meshes_.try_emplace(&object);
    if (!added) return found->second;
    Mesh mesh{.name = object.name, .positions = object.positions, .triangles = {}};
    for (const ThreeMfTriangle& triangle : object.triangles)
      mesh.triangles.push_back({triangle.vertices, material_of(part, triangle.color)});
    if (!mesh.triangles.empty()) found->second = target_.add_mesh(std::move(mesh));
    return found->second;
  }

  /// A placement is an object where the file says more of it than a number; otherwise it belongs to the one
  /// that it is in.
  SourceObjectId object_of(const ThreeMfUse& use, const ThreeMfObject& object, SourceObjectId parent) {
    const std::string& guid = use.guid.empty() ? object.guid : use.guid;
    const std::string& part_number = use.part_number.empty() ? object.part_number : use.part_number;
    if (object.name.empty() && guid.empty() && part_number.empty()) return parent;
    return target_.objects().add({.name = object.name.empty() ? part_number : object.name,
                                  .type = object.name.empty() ? "" : part_number,
                                  .guid = guid,
                                  .number = std::to_string(use.object)},
                                 parent);
  }

  void place(const std::string& from, const ThreeMfUse& use, const Affine& outer, SourceObjectId parent) {
    const uint64_t most = target_.options().max_placements;
    if (++placements_ > most) return target_.warn(fmt::format("placements beyond {} were skipped", most));
    const std::string name = use.part.empty() ? from : use.part;
    const ThreeMfPart* part = part_named(name);
    const auto found =
        part ? part->objects.find(use.object) : std::map<uint64_t, ThreeMfObject>::const_iterator();
    if (!part || found == part->objects.end())
      return target_.warn("placements of objects that are not in the file were skipped");
    const ThreeMfObject& object = found->second;
    if (std::find(open_.begin(), open_.end(), &object) != open_.end() || open_.size() >= max_depth)
      return target_.warn("objects within themselves were skipped");
    if (object.is_support)
      return target_.warn("objects of the types \"support\" and \"other\" are not drawn");
    const Affine placed = outer * glm::dmat4(use.transform);
    if (!is_usable(placed[0]) || !is_usable(placed[1]) || !is_usable(placed[2]) || !is_usable(placed[3]))
      return target_.warn("placements were dropped: their transforms are not finite");
    const SourceObjectId source = object_of(use, object, parent);
    if (const auto mesh = mesh_of(*part, object)) target_.add_instance(*mesh, placed, source);
    open_.push_back(&object);
    for (const ThreeMfUse& component : object.components) place(name, component, placed, source);
    open_.pop_back();
  }

  FileImport& target_;
  ModelArchive archive_;
  Affine to_model_{1};
  std::map<std::string, ThreeMfPart> parts_;
  std::map<const ThreeMfObject*, std::optional<uint32_t>> meshes_;
  std::map<uint32_t, uint32_t> materials_;  ///< by colour
  std::vector<const ThreeMfObject*> open_;  ///< those that hold what is being placed
  uint64_t placements_ = 0;
};

}  // namespace

void import_3mf(FileImport& target) { ArchiveImport(target).run(); }

}  // namespace triptych
