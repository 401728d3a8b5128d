#include "samples/plant/plant_site.hpp"

#include "base/error.hpp"

#include <algorithm>

namespace triptych {

namespace site {

SiteBox boiler(int number) {
  const double x = boiler_x[number];
  return {{x - 7.5, 2.5, 34.5}, {x + 7.5, 42, 49.5}};
}

SiteBox turbine(int number) {
  const double x = turbine_x[number];
  return {{x, deck, 6.5}, {x + 35, deck + 6, 17.5}};
}

std::vector<SiteBox> aisles() {
  std::vector<SiteBox> result;
  for (int i = 0; i < storeys; ++i) {
    const double floor = i * storey + 0.02, head = i * storey + head_room;
    for (const double z : {near_aisle, far_aisle})
      result.push_back({{1.5, floor, z - aisle_half}, {width - 1.5, head, z + aisle_half}});
    result.push_back({{cross_aisle - aisle_half, floor, near_aisle - aisle_half},
                      {cross_aisle + aisle_half, head, far_aisle + aisle_half}});
  }
  for (const double z : {3.0, 21.0})
    result.push_back({{1.5, deck + 0.02, z - aisle_half}, {width - 1.5, deck + head_room, z + aisle_half}});
  return result;
}

}  // namespace site

PlantSite::PlantSite(const Random& random) : random_(random), aisles_(site::aisles()) {
  for (int i = 0; i < site::boilers; ++i) take(site::boiler(i).grown(0.5));
  for (int i = 0; i < site::turbines; ++i) take(site::turbine(i).grown(0.3));
}

bool PlantSite::in_aisle(const SiteBox& box) const {
  return std::any_of(aisles_.begin(), aisles_.end(), [&](const SiteBox& aisle) { return aisle.meets(box); });
}

bool PlantSite::is_free(const SiteBox& box) const {
  return !in_aisle(box) &&
         std::none_of(taken_.begin(), taken_.end(), [&](const SiteBox& other) { return other.meets(box); });
}

glm::dvec3 PlantSite::place(const glm::dvec3& size) {
  constexpr int tries = 4000;
  for (int i = 0; i < tries; ++i) {
    const bool hall = random_.chance(0.25);
    const double x = random_.between(1 + size.x / 2, site::width - 1 - size.x / 2);
    const double z = hall ? random_.between(1 + size.z / 2, site::hall_depth - 1 - size.z / 2)
                          : random_.between(site::hall_depth + 1 + size.z / 2, site::depth - 1 - size.z / 2);
    const double floor = hall ? 0 : site::storey * static_cast<double>(random_.below(site::storeys));
    const SiteBox box{{x - size.x / 2, floor + 0.02, z - size.z / 2},
                      {x + size.x / 2, floor + size.y, z + size.z / 2}};
    if (!is_free(box)) continue;
    take(box);
    return {x, floor + 0.02, z};
  }
  fail("sample plant", "no place for a machine of {} by {} by {} metres", size.x, size.y, size.z);
}

}  // namespace triptych
