// What a piece of furniture can be used as, and which models of a catalogue take part in a building.
#pragma once

#include "samples/building/furniture_catalog.hpp"
#include "samples/random.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace triptych {

enum class FurnitureRole {
  desk,
  office_chair,
  computer,
  chair,
  big_table,
  small_table,
  bookcase,
  cabinet,
  ceiling_light,
  dustbin,
  desk_lamp,
  phone,
  desk_item,
  mug,
  book,
  small_plant,
  floor_plant,
  socket,
  light_switch,
  smoke_detector,
  radiator,
  blind,
  sofa,
  armchair,
  coffee_table,
  rug,
  whiteboard,
  wall_screen,
  projector,
  printer,
  box,
  shelf,
  ladder,
  kitchen_base,
  kitchen_sink,
  kitchen_stove,
  kitchen_upper,
  fridge,
  appliance,
  food,
  plate,
  bottle,
  stool,
  toilet,
  urinal,
  washbasin,
  paper_dispenser,
  towel,
  soap,
  water_cooler,
  extinguisher,
  emergency_sign,
  bench,
  camera,
  hanger,
  person,
  game,
  exercise,
  floor_lamp,
  ornament,
  wall_lamp,
  cleaning,
  safe_box,
  device,
  count
};
inline constexpr size_t role_count = static_cast<size_t>(FurnitureRole::count);

/// For each role the numbers of catalogue pieces that fit it.
struct RolePools {
  std::array<std::vector<size_t>, role_count> pieces;
  const std::vector<size_t>& operator[](FurnitureRole role) const {
    return pieces[static_cast<size_t>(role)];
  }
};

/// A guess from the size of the model's text alone, so that only models that take part need be read.
uint64_t guessed_triangles(const FurniturePiece& piece);

/// Picks the models by category, words of the name and size, in a random order, while their guessed triangles
/// stay within the budget; every role that has a candidate gets at least one, its smallest if need be.
RolePools choose_pools(const Furniture& furniture, uint64_t unique_triangles, size_t models, Random random);

}  // namespace triptych
