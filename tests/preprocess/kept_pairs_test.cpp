// What earlier builds found of pairs.
#include "preprocess/kept_pairs.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

/// Of the numbers below ten.
std::vector<ContentKey> keys() {
  std::vector<ContentKey> keys;
  for (uint64_t number = 0; number < 10; ++number) {
    ContentKeyWriter key;
    key.write(number);
    keys.push_back(key.key());
  }
  return keys;
}

/// Asks for pairs of numbers; how many were made.
int ask(KeptPairs& pairs, const std::vector<std::pair<uint32_t, uint32_t>>& list) {
  int made = 0;
  for (const auto& [a, b] : list) {
    std::vector<uint64_t> expected(b, a);
    EXPECT_EQ(pairs.get<uint64_t>(keys(), a, b,
                                  [&] {
                                    ++made;
                                    return expected;
                                  }),
              expected);
  }
  return made;
}

TEST(KeptPairs, are_found_again_in_any_order_and_new_ones_are_made) {
  KeptPairs first{std::vector<std::byte>()};
  EXPECT_EQ(ask(first, {{1, 2}, {3, 0}, {4, 5}}), 3);  // one of which nothing was found
  KeptPairs second(first.bytes());
  EXPECT_EQ(ask(second, {{4, 5}, {1, 2}, {6, 1}, {3, 0}}), 1);
  KeptPairs third(second.bytes());
  EXPECT_EQ(ask(third, {{6, 1}, {3, 0}}), 0);
  KeptPairs fourth(third.bytes());
  EXPECT_EQ(ask(fourth, {{1, 2}}), 1);  // the one before did not ask for it
}

TEST(KeptPairs, that_are_not_used_keep_nothing) {
  KeptPairs none;
  EXPECT_EQ(ask(none, {{1, 2}, {1, 2}}), 2);
}

}  // namespace
}  // namespace triptych
