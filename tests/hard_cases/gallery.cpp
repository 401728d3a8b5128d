#include "tests/hard_cases/hard_case.hpp"

#include <algorithm>

namespace triptych::hard_cases {

namespace {
std::vector<HardCase>& entered() {
  static std::vector<HardCase> cases;
  return cases;
}
}  // namespace

const std::vector<HardCase>& gallery() {
  std::vector<HardCase>& cases = entered();
  std::sort(cases.begin(), cases.end(), [](const HardCase& a, const HardCase& b) { return a.name < b.name; });
  return cases;
}

InGallery::InGallery(HardCase hard_case) { entered().push_back(std::move(hard_case)); }

}  // namespace triptych::hard_cases
