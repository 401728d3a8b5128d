// What the power plant consists of: each function adds objects, which become triangles only when asked.
#pragma once

#include "samples/plant/plant_site.hpp"
#include "samples/shape.hpp"

#include <functional>
#include <string>
#include <vector>

namespace triptych {

struct PlantObject {
  std::string name;
  /// About how many triangles it has in a plant of 12.7 million; others are in proportion.
  double weight = 0;
  /// The shape, with as many small parts as so many triangles allow.
  std::function<Shape(uint64_t triangles)> make;
};
using PlantObjects = std::vector<PlantObject>;

/// Columns, beams, floors of gratings, walls, roofs, stairs, railings.
void add_structure(PlantObjects& objects, PlantSite& site);
/// Boilers with water walls, turbines, generators and condensers.
void add_boilers(PlantObjects& objects);
void add_turbines(PlantObjects& objects);
/// Mills, fans, tanks, pumps, valves, heat exchangers, cabinets, lamps, ducts, cable trays, bolts.
void add_machines(PlantObjects& objects, PlantSite& site, Random random);

/// One object through the whole plant: a shape for each of its services, of so many triangles each.
inline constexpr size_t pipe_services = 8;
Shape make_pipes(const PlantSite& site, size_t service, uint64_t triangles, Random random);

}  // namespace triptych
