// Every case's pictures, culled and un-culled, on each device.
#include "tests/hard_cases/hard_case_test.hpp"
#include "tests/support/test_device.hpp"

namespace triptych::hard_cases {
namespace {

class HardPictures : public Case {};

TEST_P(HardPictures, are_the_un_culled_ones) {
  expect_none(picture_problems(hard_case().make(), test::device()));
}

TRIPTYCH_ON_EVERY_CASE(HardPictures);

}  // namespace
}  // namespace triptych::hard_cases
