#include "samples/building/stairs.hpp"

#include "samples/solids.hpp"

namespace triptych {
namespace {

using namespace measures;

constexpr int steps = 10;  // a flight
constexpr double tread = 0.28, thickness = 0.05, landing_depth = 1.3;

/// Steps from z0 in direction `towards` (+1, -1), the first one rise above `base`.
void add_flight(MeshPart& treads, double x0, double x1, double z0, int towards, double base) {
  const double rise = storey / (2 * steps);
  for (int i = 0; i < steps; ++i) {
    const double top = base + rise * (i + 1), from = z0 + towards * tread * i, to = from + towards * tread;
    append(treads, box({x0, top - rise - thickness, std::min(from, to)}, {x1, top, std::max(from, to)},
                       treads.colour));
  }
}

}  // namespace

std::vector<MeshPart> stair_flights(const Rect& opening, bool west) {
  MeshPart treads, landing;
  treads.colour = {0.40, 0.40, 0.39};
  const double middle = opening.centre().x, gap = 0.03;
  const glm::dvec2 outer =
      west ? glm::dvec2(middle + gap, opening.x1 - 0.02) : glm::dvec2(opening.x0 + 0.02, middle - gap);
  const glm::dvec2 inner =
      west ? glm::dvec2(opening.x0 + 0.02, middle - gap) : glm::dvec2(middle + gap, opening.x1 - 0.02);
  const double turn = opening.z1 - steps * tread;
  // The last step of each flight is the landing, or the floor above, itself.
  add_flight(treads, outer.x, outer.y, opening.z1, -1, 0);
  add_flight(treads, inner.x, inner.y, turn, 1, storey / 2);
  landing = box({opening.x0 + 0.02, storey / 2 - 0.2, turn - landing_depth},
                {opening.x1 - 0.02, storey / 2, turn}, {0.42, 0.42, 0.41});
  return {treads, landing};
}

}  // namespace triptych
