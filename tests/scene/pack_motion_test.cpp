#include "scene/pack_motion.hpp"

#include "base/error.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace triptych {
namespace {

StoredMotion some_motion() {
  StoredMotion stored;
  stored.motion.tracks = {{Interpolation::linear, 4, 2, {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0}},
                          {Interpolation::cubic_spline, 3, 3, {1}, {0, 0, 0, 1, 2, 3, 0, 0, 0}}};
  stored.motion.joints = {{.rotation_track = 0}, {.parent = 0, .translation_track = 1}};
  stored.instances = {{0, 1}, {3, 0}};
  return stored;
}

std::string error_of(const std::function<void()>& reads) {
  try {
    reads();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(PackMotion, comes_back_as_it_was) {
  const StoredMotion stored = some_motion(), read = decode_motion(encode_motion(stored), 4, "here");
  EXPECT_EQ(read.motion, stored.motion);
  EXPECT_EQ(read.instances, stored.instances);
}

TEST(PackMotion, bytes_that_are_none_are_refused_with_their_place) {
  const std::vector<std::byte> bytes = encode_motion(some_motion());
  for (size_t size = 0; size < bytes.size(); ++size) {
    const std::string error = error_of([&] { decode_motion(std::span(bytes).first(size), 4, "here"); });
    ASSERT_TRUE(error.starts_with("here: ")) << size << ": " << error;
  }
  std::vector<std::byte> longer = bytes;
  longer.emplace_back();
  EXPECT_NE(error_of([&] { decode_motion(longer, 4, "here"); }), "");
  const auto refused = [](const std::function<void(StoredMotion&)>& spoil, size_t instances = 4) {
    StoredMotion stored = some_motion();
    spoil(stored);
    return error_of([&] { decode_motion(encode_motion(stored), instances, "here"); });
  };
  EXPECT_EQ(refused([](StoredMotion&) {}, 3), "here: instance 3 is not one of those that may follow");
  EXPECT_EQ(refused([](StoredMotion& m) { m.instances[1].instance = 0; }),
            "here: instance 0 is not one of those that may follow");
  EXPECT_EQ(refused([](StoredMotion& m) { m.instances[0].joint = 2; }),
            "here: instance 0 follows joint 2 of 2");
  EXPECT_EQ(refused([](StoredMotion& m) { m.instances.clear(); }), "here: moves nothing");
  EXPECT_NE(refused([](StoredMotion& m) { m.motion.tracks[0].values[0] = NAN; }), "");
}

}  // namespace
}  // namespace triptych
