// Every case's pictures, culled and un-culled, in each kind of context: queries in one, the storage test in
// the other.
#include "tests/hard_cases/hard_case_test.hpp"
#include "tests/render/rig.hpp"

namespace triptych::hard_cases {
namespace {

class HardPictures : public Case {};

TEST_P(HardPictures, are_the_un_culled_ones) {
  test_context();
  const char* kind = std::getenv("TRIPTYCH_TEST_CONTEXT");
  const bool osmesa = kind != nullptr && std::string(kind) == "osmesa";
  expect_none(picture_problems(hard_case().make(), osmesa ? TestKind::queries : TestKind::storage));
}

TRIPTYCH_ON_EVERY_CASE(HardPictures);

}  // namespace
}  // namespace triptych::hard_cases
