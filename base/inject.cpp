#include "base/inject.hpp"

#include <algorithm>

namespace triptych {

namespace {
uint64_t& active_faults() {
  static uint64_t mask = 0;
  return mask;
}
}  // namespace

const std::vector<std::string>& fault_names() {
  static const std::vector<std::string> names = {"withheld-id",
                                                 "wrong-delta",
                                                 "no-digest",
                                                 "strict-depth-test",
                                                 "no-dilation",
                                                 "wrong-ancestor",
                                                 "stale-camera",
                                                 "stale-motion",
                                                 "flipped-byte",
                                                 "carried-hidden",
                                                 "no-near-rule",
                                                 "no-fragment-bound",
                                                 "float-bounds",
                                                 "float-positions",
                                                 "fixed-units",
                                                 "euclidean-depth",
                                                 "dropped-stretch",
                                                 "perspective-rule",
                                                 "dropped-singular-value",
                                                 "uncounted-lattice",
                                                 "shrinking-bounds",
                                                 "unflipped-mirror",
                                                 "shared-shears",
                                                 "loose-contacts",
                                                 "no-room",
                                                 "untold-layers",
                                                 "wide-layers",
                                                 "unmarked-levels",
                                                 "exact-frustum",
                                                 "cut-occludes",
                                                 "backs-nearby",
                                                 "hidden-occludes",
                                                 "hollow-levels",
                                                 "opaque-glass",
                                                 "walls-before-near",
                                                 "slow-render-node",
                                                 "slow-switch-node"};
  return names;
}

bool inject(std::string_view name) {
  const auto& names = fault_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return false;
  active_faults() |= uint64_t{1} << (found - names.begin());
  return true;
}

bool injected(Fault fault) { return (active_faults() >> static_cast<uint32_t>(fault) & 1u) != 0; }

std::vector<std::string> injected_names() {
  std::vector<std::string> active;
  for (size_t i = 0; i < fault_names().size(); ++i) {
    if (injected(static_cast<Fault>(i))) active.push_back(fault_names()[i]);
  }
  return active;
}

void clear_injected() { active_faults() = 0; }

}  // namespace triptych
