// Where things are in the power plant: the house, its storeys, what must stay free, and what is taken.
#pragma once

#include "samples/random.hpp"

#include <glm/glm.hpp>
#include <vector>

namespace triptych {

/// A box along the axes, in metres; y up.
struct SiteBox {
  glm::dvec3 low{0}, high{0};
  bool meets(const SiteBox& other) const {
    return glm::all(glm::lessThan(low, other.high)) && glm::all(glm::lessThan(other.low, high));
  }
  SiteBox grown(double by) const { return {low - by, high + by}; }
};

namespace site {

inline constexpr double width = 96, hall_depth = 24, depth = 60, hall_height = 28, height = 46;
inline constexpr double bay = 8, strip = 9, storey = 6, deck = 10;  ///< deck: the turbines' floor
inline constexpr int bays = 12, strips = 4, storeys = 7, boilers = 2, turbines = 2;
inline constexpr double boiler_x[boilers] = {24, 72}, turbine_x[turbines] = {8, 54};
inline constexpr double near_aisle = 29, far_aisle = 55.5, cross_aisle = 48;  ///< z, z and x
inline constexpr double aisle_half = 0.9, head_room = 2.3;

/// The inside of the boiler, walls and all.
SiteBox boiler(int number);
/// One turbine with its generator, above the deck.
SiteBox turbine(int number);
/// Walkways that nothing may enter, from the floor to above a head: two along each storey of the boiler house
/// and one across, and two along the deck.
std::vector<SiteBox> aisles();

}  // namespace site

/// Hands out places so that machines do not stand in each other.
class PlantSite {
 public:
  explicit PlantSite(const Random& random);

  /// Takes a free place of this size on a random floor of the boiler house or the hall's ground: the middle
  /// of its bottom. Error if the plant is full.
  glm::dvec3 place(const glm::dvec3& size);
  bool is_free(const SiteBox& box) const;
  bool in_aisle(const SiteBox& box) const;
  void take(const SiteBox& box) { taken_.push_back(box); }

 private:
  Random random_;
  std::vector<SiteBox> aisles_, taken_;
};

}  // namespace triptych
