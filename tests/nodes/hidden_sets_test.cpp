// Sets of hidden objects that come as messages.
#include "nodes/hidden_sets.hpp"

#include "base/error.hpp"
#include "nodes/replay.hpp"
#include "tests/protocol/sample_messages.hpp"
#include "tests/support/object_sets.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

const Pack& pack() { return scenes::pack_with_objects("room"); }

FrameState naming(const ObjectSet& set) {
  FrameState state{sample_view()};
  state.hiding.name = hidden_name(set);
  return state;
}

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(HiddenSets, complete_the_frames_that_name_them) {
  HiddenSets sets(pack());
  sets.add({7, {1, 2, 5}});
  sets.add({8, {3}});
  FrameState state = naming({1, 2, 5});
  sets.complete(state);
  ASSERT_TRUE(state.hiding.objects);
  EXPECT_EQ(state.hiding.objects->objects(), (ObjectSet{1, 2, 5}));
  FrameState nothing{sample_view()};
  sets.complete(nothing);
  EXPECT_FALSE(nothing.hiding.objects);
}

TEST(HiddenSets, that_did_not_come_are_missed) {
  HiddenSets sets(pack());
  FrameState state = naming({1, 2});
  EXPECT_NE(error_of([&] { sets.complete(state); }).find("of 2 objects was not sent"), std::string::npos);
  sets.add({7, {1, 3}});
  EXPECT_NE(error_of([&] { sets.complete(state); }), "");
}

TEST(HiddenSets, of_another_pack_are_refused) {
  HiddenSets sets(pack());
  EXPECT_NE(error_of([&] { sets.add({7, {1, 1'000'000}}); }).find("object 1000000 of"), std::string::npos);
}

TEST(HiddenSets, are_kept_while_they_are_among_the_last_few) {
  HiddenSets sets(pack());
  for (SourceObjectId id = 0; id < 4; ++id) sets.add({id, {id}});
  sets.add({5, {0}});  // again: it is the last one now
  sets.add({6, {9}});
  FrameState again = naming({0}), old = naming({1});
  sets.complete(again);
  EXPECT_TRUE(again.hiding.objects);
  EXPECT_NE(error_of([&] { sets.complete(old); }), "");
}

TEST(HiddenSets, in_a_recording_complete_its_frames_and_are_missed_where_they_are_not) {
  const auto recorded = [](Message message) {
    return RecordedMessage{0, true, Role::render, Channel::camera, std::move(message)};
  };
  const CameraMessage camera{3, naming({1, 2})};
  Replay replay(pack(), "recording");
  EXPECT_NE(error_of([&] { replay.take(recorded(camera)); }).find("recording frame 3: hidden set"),
            std::string::npos);
  Replay whole(pack(), "recording");
  EXPECT_TRUE(whole.take(recorded(HiddenSet{3, {1, 2}})).empty());
  const std::vector<ReplayedFrame> frames = whole.take(recorded(camera));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_TRUE(frames[0].request.state.hiding.objects);
}

}  // namespace
}  // namespace triptych
