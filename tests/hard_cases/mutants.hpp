// Puts the faults in that the cases name, and looks whether the cases notice.
#pragma once

#include "tests/hard_cases/trials.hpp"

#include <string>
#include <vector>

namespace triptych::hard_cases {

/// Every named fault (or those given) against every case that names it, as a table on standard output.
/// Returns how many pairs went wrong: a case that does not notice its fault, or fails without it. A context
/// must be current.
int run_mutants(const std::vector<std::string>& only);

}  // namespace triptych::hard_cases
