#include "nodes/hidden_sets.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <utility>

namespace triptych {

namespace {
const std::string place = "hidden set";

auto find(auto& sets, const HiddenName& name) {
  return std::find_if(sets.begin(), sets.end(), [&](const Hiding& set) { return set.name == name; });
}
}  // namespace

void HiddenSets::add(const HiddenSet& set) {
  const auto known = find(sets_, hidden_name(set.objects));
  Hiding hiding;
  if (known != sets_.end()) {
    hiding = std::move(*known);
    sets_.erase(known);
  } else {
    if (!objects_) objects_.emplace(pack_.read_objects());
    hiding = hide(pack_.skeleton(), *objects_, set.objects, place);
  }
  sets_.push_back(std::move(hiding));
  if (sets_.size() > most) sets_.pop_front();
}

void HiddenSets::complete(FrameState& state) const {
  if (state.hiding.name == HiddenName()) return;
  const auto known = find(sets_, state.hiding.name);
  if (known == sets_.end())
    fail(place, "of {} objects was not sent before its frame", state.hiding.name.count);
  state.hiding = *known;
}

}  // namespace triptych
