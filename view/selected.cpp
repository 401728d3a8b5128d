#include "view/selected.hpp"

#include "base/in_threes.hpp"
#include "view/measurement.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <glm/common.hpp>

namespace triptych {

void Selected::set(Selection selection) {
  all_.clear();
  all_.push_back(std::move(selection));
}

bool Selected::toggle(Selection selection) {
  const auto found = std::find_if(all_.begin(), all_.end(),
                                  [&](const Selection& other) { return same_thing(other, selection); });
  if (found == all_.end()) {
    all_.push_back(std::move(selection));
    return true;
  }
  all_.erase(found);
  return false;
}

Box Selected::box() const {
  Box box;
  for (const Selection& selection : all_) box.extend(selection.box);
  return box;
}

std::vector<SourceObjectId> Selected::objects() const {
  std::vector<SourceObjectId> objects;
  for (const Selection& selection : all_) {
    if (selection.object != no_id) objects.push_back(selection.object);
  }
  return objects;
}

uint64_t Selected::triangles() const {
  uint64_t sum = 0;
  for (const Selection& selection : all_) sum += selection.triangles;
  return sum;
}

std::string Selected::name() const {
  if (all_.empty()) return "";
  if (all_.size() == 1) return all_.front().name;
  const bool all_objects = objects().size() == all_.size();
  return fmt::format("{} {}", all_.size(), all_objects ? "objects" : "pieces");
}

std::string Selected::sum(const ModelSystem& system) const {
  const uint64_t count = triangles();
  std::string text =
      fmt::format("{} triangle{}", in_threes(static_cast<double>(count)), count == 1 ? "" : "s");
  const Box around = box();
  if (around.empty()) return text;
  const glm::dvec3 size = glm::abs(system.own(around.hi - around.lo));
  return text + fmt::format(", {} x {} x {} {}", number_text(size.x), number_text(size.y),
                            number_text(size.z), system.unit);
}

}  // namespace triptych
