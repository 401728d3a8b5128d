// Every case is built soundly, and its cuts keep the pixel error.
#include "base/inject.hpp"
#include "tests/hard_cases/hard_case_test.hpp"

#include <set>

namespace triptych::hard_cases {
namespace {

class HardBuild : public Case {};

TEST_P(HardBuild, is_sound) { expect_none(build_problems(hard_case().make())); }

TEST_P(HardBuild, has_cuts_that_cover_the_frustum_within_the_pixel_error) {
  expect_none(cut_problems(hard_case().make()));
}

TRIPTYCH_ON_EVERY_CASE(HardBuild);

TEST(Gallery, has_fifty_cases_of_which_each_says_what_breaks_and_every_fault_is_named) {
  EXPECT_GE(gallery().size(), 50u);
  std::set<std::string> names, faults;
  for (const HardCase& entry : gallery()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name << " twice";
    EXPECT_TRUE(entry.name.starts_with(entry.group + "_")) << entry.name;
    EXPECT_GT(entry.breaks.size(), 20u) << entry.name;
    for (const std::string& fault : entry.faults) faults.insert("+" + fault + "+");
  }
  for (const std::string& fault : fault_names()) {
    if (fault.starts_with("slow-")) continue;  // changes no picture; sessions are tried with them
    bool named = false;
    for (const std::string& several : faults)
      named = named || several.find("+" + fault + "+") != std::string::npos;
    EXPECT_TRUE(named) << "no case catches " << fault;
  }
}

}  // namespace
}  // namespace triptych::hard_cases
