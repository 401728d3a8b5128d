// Deltas between visible sets.
#include "visibility/visible_set.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <set>

namespace triptych {
namespace {

VisibleSet some_set() {
  const auto ids = *rc::gen::container<std::set<DrawableId>>(rc::gen::inRange<DrawableId>(0, 60));
  return {ids.begin(), ids.end()};
}

TEST(VisibleSet, the_difference_applied_gives_the_other_set) {
  EXPECT_TRUE(rc::check([] {
    VisibleSet before = some_set();
    const VisibleSet after = some_set();
    RC_ASSERT(apply_delta(difference(before, after), before));
    RC_ASSERT(before == after);
  }));
}

TEST(VisibleSet, the_difference_names_only_what_changed) {
  EXPECT_TRUE(rc::check([] {
    const VisibleSet before = some_set(), after = some_set();
    const VisibleDelta delta = difference(before, after);
    for (const DrawableId id : delta.added) {
      RC_ASSERT(std::binary_search(after.begin(), after.end(), id) &&
                !std::binary_search(before.begin(), before.end(), id));
    }
    for (const DrawableId id : delta.removed) {
      RC_ASSERT(std::binary_search(before.begin(), before.end(), id) &&
                !std::binary_search(after.begin(), after.end(), id));
    }
    RC_ASSERT(difference(before, before).size() == 0u);
    RC_ASSERT(difference(after, before) == (VisibleDelta{delta.removed, delta.added}));
  }));
}

TEST(VisibleSet, any_delta_is_applied_as_sets_have_it_or_refused_untouched) {
  EXPECT_TRUE(rc::check([] {
    const VisibleSet before = some_set();
    const VisibleDelta delta = {*rc::gen::arbitrary<std::vector<DrawableId>>(), some_set()};
    std::set<DrawableId> expected(before.begin(), before.end());
    bool fits = std::is_sorted(delta.added.begin(), delta.added.end());
    for (const DrawableId id : delta.removed) fits = expected.erase(id) == 1 && fits;
    for (const DrawableId id : delta.added) fits = expected.insert(id).second && fits;
    VisibleSet set = before;
    RC_ASSERT(apply_delta(delta, set) == fits);
    RC_ASSERT(set == (fits ? VisibleSet(expected.begin(), expected.end()) : before));
  }));
}

TEST(VisibleSet, a_delta_that_does_not_fit_is_refused) {
  const VisibleSet before = {2, 4, 6};
  const std::vector<VisibleDelta> wrong = {{{4}, {}},    {{}, {5}},    {{5, 3}, {}}, {{3, 3}, {}},
                                           {{}, {6, 2}}, {{}, {2, 2}}, {{1, 2}, {4}}};
  for (const VisibleDelta& delta : wrong) {
    VisibleSet set = before;
    EXPECT_FALSE(apply_delta(delta, set));
    EXPECT_EQ(set, before);
  }
}

}  // namespace
}  // namespace triptych
