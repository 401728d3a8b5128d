#include "samples/building/obj_furniture.hpp"

#include "base/error.hpp"
#include "samples/building/image_average.hpp"
#include "samples/building/obj_text.hpp"

#include <array>
#include <bit>
#include <limits>
#include <map>
#include <unordered_map>

namespace triptych {
namespace {

struct PositionHash {
  size_t operator()(const std::array<uint32_t, 3>& bits) const {
    uint64_t value = bits[0];
    for (size_t i = 1; i < bits.size(); ++i) value = (value ^ (value >> 29)) * 0xbf58476d1ce4e5b9u + bits[i];
    return static_cast<size_t>(value ^ (value >> 31));
  }
};

/// The model's positions in the piece's own axes and size.
std::vector<glm::vec3> catalogue_positions(const ObjModel& model, const FurniturePiece& piece) {
  const auto& r = piece.rotation;
  const glm::dmat3 rotation(r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]);  // glm's are columns
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  std::vector<glm::dvec3> turned;
  turned.reserve(model.positions.size());
  for (const auto& position : model.positions) turned.push_back(rotation * position);
  for (const auto& polygons : model.polygons) {
    for (const uint32_t corner : polygons.corners) {
      low = glm::min(low, turned[corner]);
      high = glm::max(high, turned[corner]);
    }
  }
  const glm::dvec3 extent = high - low;
  glm::dvec3 scale(1);
  for (int axis = 0; axis < 3; ++axis)
    if (extent[axis] > 0) scale[axis] = piece.size[axis] / extent[axis];
  const glm::dvec3 origin((low.x + high.x) / 2, low.y, (low.z + high.z) / 2);
  std::vector<glm::vec3> positions;
  positions.reserve(turned.size());
  for (const auto& position : turned) positions.emplace_back((position - origin) * scale);
  return positions;
}

/// Cuts polygons into fans; corners at equal places become one.
MeshPart triangulate(const ObjPolygons& polygons, const std::vector<glm::vec3>& positions,
                     uint64_t& collapsed) {
  MeshPart part;
  std::unordered_map<std::array<uint32_t, 3>, uint32_t, PositionHash> numbers;
  const auto number = [&](const glm::vec3& position) {
    const auto bits = std::bit_cast<std::array<uint32_t, 3>>(position);
    const auto [found, added] = numbers.try_emplace(bits, static_cast<uint32_t>(part.positions.size()));
    if (added) part.positions.push_back(position);
    return found->second;
  };
  size_t first = 0;
  for (const uint32_t size : polygons.sizes) {
    const auto corner = [&](size_t i) {
      return positions[polygons.corners[first + i]] + glm::vec3(0.0f);  // no negative zeros
    };
    for (size_t i = 2; i < size; ++i) {
      const glm::vec3 a = corner(0), b = corner(i - 1), c = corner(i);
      if (a == b || b == c || c == a) {
        ++collapsed;
        continue;
      }
      for (const glm::vec3& position : {a, b, c}) part.indices.push_back(number(position));
    }
    first += size;
  }
  return part;
}

class Materials {
 public:
  Materials(const ObjModel& model, const FurniturePiece& piece, const ZipArchive& archive)
      : folder_(piece.model.substr(0, piece.model.rfind('/') + 1)), archive_(archive) {
    for (const auto& library : model.material_libraries) {
      const std::string file = folder_ + library;
      if (!archive.contains(file)) continue;  // its materials are counted as undefined where they are used
      materials_.merge(parse_mtl(archive.read(file), archive.path().string() + "!" + file));
    }
  }

  glm::dvec3 colour(const std::string& name, FurnitureMesh& mesh) const {
    const auto found = materials_.find(name);
    if (found == materials_.end()) {
      ++mesh.undefined_materials;
      return glm::dvec3(0.6);
    }
    const ObjMaterial& material = found->second;
    if (material.opacity < 1) ++mesh.transparent_materials;
    glm::dvec3 colour;
    for (int channel = 0; channel < 3; ++channel)
      colour[channel] = linear_from_srgb(glm::clamp(material.diffuse[channel], 0.0, 1.0));
    if (material.texture.empty()) return colour;
    const std::string file = folder_ + material.texture;
    const auto average = archive_.contains(file) ? average_colour(archive_.read(file)) : std::nullopt;
    if (!average) ++mesh.undecoded_images;
    return average ? colour * *average : colour;
  }

  /// Never so little that it does not show.
  double alpha(const std::string& name) const {
    const auto found = materials_.find(name);
    return found == materials_.end() ? 1 : glm::clamp(found->second.opacity, 0.2, 1.0);
  }

 private:
  std::string folder_;
  const ZipArchive& archive_;
  std::map<std::string, ObjMaterial> materials_;
};

}  // namespace

FurnitureMesh read_furniture(const FurniturePiece& piece, const ZipArchive& archive, bool shows_glass) {
  const std::string place = archive.path().string() + "!" + piece.model;
  const ObjModel model = parse_obj(archive.read(piece.model), place);
  const auto positions = catalogue_positions(model, piece);
  const Materials materials(model, piece, archive);
  FurnitureMesh mesh;
  for (size_t i = 0; i < model.materials.size(); ++i) {
    MeshPart part = triangulate(model.polygons[i], positions, mesh.collapsed_triangles);
    if (part.indices.empty()) continue;
    part.colour = materials.colour(model.materials[i], mesh);
    if (shows_glass) part.alpha = materials.alpha(model.materials[i]);
    mesh.triangles += part.indices.size() / 3;
    mesh.parts.push_back(std::move(part));
  }
  if (mesh.parts.empty()) fail(place, "no triangles");
  return mesh;
}

}  // namespace triptych
