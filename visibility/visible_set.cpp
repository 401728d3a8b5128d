#include "visibility/visible_set.hpp"

#include <algorithm>
#include <iterator>

namespace triptych {

namespace {
bool strictly_ascending(const std::vector<DrawableId>& ids) {
  return std::adjacent_find(ids.begin(), ids.end(), [](DrawableId a, DrawableId b) { return a >= b; }) ==
         ids.end();
}
}  // namespace

VisibleDelta difference(const VisibleSet& before, const VisibleSet& after) {
  VisibleDelta delta;
  difference(before, after, delta);
  return delta;
}

void difference(const VisibleSet& before, const VisibleSet& after, VisibleDelta& delta) {
  delta.added.clear();
  delta.removed.clear();
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                      std::back_inserter(delta.added));
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(),
                      std::back_inserter(delta.removed));
}

bool apply_delta(const VisibleDelta& delta, VisibleSet& set) {
  if (!strictly_ascending(delta.added) || !strictly_ascending(delta.removed)) return false;
  if (!std::includes(set.begin(), set.end(), delta.removed.begin(), delta.removed.end())) return false;
  VisibleSet kept, result;
  std::set_difference(set.begin(), set.end(), delta.removed.begin(), delta.removed.end(),
                      std::back_inserter(kept));
  std::set_union(kept.begin(), kept.end(), delta.added.begin(), delta.added.end(),
                 std::back_inserter(result));
  if (result.size() != kept.size() + delta.added.size()) return false;
  set = std::move(result);
  return true;
}

}  // namespace triptych
