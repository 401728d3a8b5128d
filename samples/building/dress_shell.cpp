#include "samples/building/dressing.hpp"
#include "samples/building/dressing_images.hpp"

#include <algorithm>
#include <string_view>

namespace triptych {

namespace {

using namespace measures;

/// Along x and z both, as walls that run along either.
constexpr int along_walls = 3;

/// Lays the image over the part along two axes of its space (0 x, 1 y, 2 z); y goes up in the image.
void lay(MeshPart& part, const SurfaceImage& image, int across, int up, const glm::dvec3& tint) {
  part.texture = std::string(images_folder) + "/" + image.name;
  part.colour = glm::min(tint, glm::dvec3(1));
  part.texture_places.clear();
  for (const glm::vec3& position : part.positions) {
    const float u = across == along_walls ? position.x + position.z : position[across];
    part.texture_places.emplace_back(u / image.width, -position[up] / image.height);
  }
}

void lay_floor(MeshPart& floor, std::string_view name) {
  const auto is = [&](RoomType type) { return name.ends_with(std::string(room_type_name(type)) + " floor"); };
  const auto is_any = [&](std::initializer_list<RoomType> types) { return std::ranges::any_of(types, is); };
  using namespace surface_images;
  if (is_any({RoomType::open_office, RoomType::classroom, RoomType::computer_room, RoomType::library}))
    return lay(floor, carpet, 0, 2, floor.colour * 1.7);
  if (is_any({RoomType::kitchen, RoomType::lavatory, RoomType::copy_room, RoomType::store}))
    return lay(floor, tiles, 0, 2, glm::dvec3(0.9, 0.9, 0.88));
  if (is_any({RoomType::corridor, RoomType::hall, RoomType::stairs}))
    return lay(floor, terrazzo, 0, 2, glm::dvec3(0.95));
  lay(floor, planks, 0, 2, glm::dvec3(1));
}

/// Two panes in the plane of the frame.
MeshPart panes() {
  constexpr double half = window_width / 2, bar = 0.05;
  MeshPart glass;
  glass.colour = {0.55, 0.72, 0.76};
  glass.alpha = 0.22;
  for (const auto& [from, to] : {std::pair(-half + bar, -bar / 2), {bar / 2, half - bar}}) {
    const auto first = static_cast<uint32_t>(glass.positions.size());
    for (const auto& [x, y] : {std::pair(from, window_sill + bar),
                               {to, window_sill + bar},
                               {to, window_top - bar},
                               {from, window_top - bar}})
      glass.positions.emplace_back(x, y, 0);
    for (const uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) glass.indices.push_back(first + corner);
  }
  return glass;
}

}  // namespace

void dress_shell(std::vector<ShellObject>& shell) {
  using namespace surface_images;
  for (ShellObject& object : shell) {
    const std::string_view name = object.name;
    MeshPart& part = object.parts.at(0);
    if (name.ends_with(" floor")) lay_floor(part, name);
    if (name.ends_with(" ceiling")) lay(part, panels, 0, 2, part.colour * 1.15);
    if (name.ends_with(" facade")) lay(part, bricks, along_walls, 1, glm::dvec3(1));
    if (name == "roof parapet") lay(part, bricks, along_walls, 1, glm::dvec3(1));
    if (name == "ground") lay(part, grass, 0, 2, glm::dvec3(1));
    if (name == "door leaf") lay(part, door, 2, 1, glm::dvec3(1));
    if (name == "window") object.parts.push_back(panes());
  }
}

}  // namespace triptych
