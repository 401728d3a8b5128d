// Every case in three processes of the real program.
#include "tests/hard_cases/hard_case_test.hpp"

namespace triptych::hard_cases {
namespace {

class HardSession : public Case {};

TEST_P(HardSession, shows_the_un_culled_pictures) { expect_none(session_problems(hard_case().make())); }

TRIPTYCH_ON_EVERY_CASE(HardSession);

}  // namespace
}  // namespace triptych::hard_cases
