// Tests that take every case of the gallery.
#pragma once

#include "tests/hard_cases/trials.hpp"

#include <gtest/gtest.h>

namespace triptych::hard_cases {

/// With gtest's own name for each case.
class Case : public testing::TestWithParam<std::string> {
 protected:
  static const HardCase& hard_case() {
    for (const HardCase& entry : gallery()) {
      if (entry.name == GetParam()) return entry;
    }
    throw std::invalid_argument("no hard case is called " + GetParam());
  }
  static void expect_none(const Problems& problems) {
    for (const std::string& problem : problems)
      ADD_FAILURE() << problem << "\n(" << hard_case().breaks << ")";
  }
};

inline std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const HardCase& entry : gallery()) names.push_back(entry.name);
  return names;
}

}  // namespace triptych::hard_cases

/// Runs the suite on every case.
#define TRIPTYCH_ON_EVERY_CASE(suite)                                                               \
  INSTANTIATE_TEST_SUITE_P(Gallery, suite, testing::ValuesIn(::triptych::hard_cases::case_names()), \
                           [](const auto& parameter) { return parameter.param; })
