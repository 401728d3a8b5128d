#include "scene/motion.hpp"

#include "base/error.hpp"
#include "scene/motion_tracks.hpp"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <random>

namespace triptych {
namespace {

constexpr uint32_t none = MotionJoint::none;

MotionTrack track(Interpolation interpolation, uint32_t components, std::vector<double> times,
                  std::vector<double> values) {
  const double length = times.back();
  return {interpolation, components, length, std::move(times), std::move(values)};
}

class Dice {
 public:
  explicit Dice(uint32_t seed) : engine_(seed) {}
  double number(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(engine_);
  }

 private:
  std::mt19937 engine_;
};

/// Any track; quaternions of any length.
MotionTrack random_track(Dice& dice, uint32_t components, Interpolation interpolation) {
  MotionTrack made{interpolation, components, 0, {}, {}};
  double time = dice.number(0, 0.5);
  for (int key = 0; key < 5; ++key, time += dice.number(0.1, 1)) {
    made.times.push_back(time);
    const uint32_t count = components * (interpolation == Interpolation::cubic_spline ? 3 : 1);
    for (uint32_t i = 0; i < count; ++i) made.values.push_back(dice.number(-1, 1));
  }
  made.length = made.times.back() + dice.number(0, 1);
  return made;
}

Motion random_motion(uint32_t seed) {
  Dice dice(seed);
  Motion motion;
  for (uint32_t joint = 0; joint < 3; ++joint) {
    MotionJoint made{.parent = joint == 0 ? none : joint - 1};
    const auto interpolation = [&] {
      return static_cast<Interpolation>(static_cast<int>(dice.number(0, 3)));
    };
    for (uint32_t* const index : {&made.translation_track, &made.rotation_track, &made.scale_track}) {
      if (dice.number(0, 1) < 0.2) continue;
      *index = static_cast<uint32_t>(motion.tracks.size());
      motion.tracks.push_back(random_track(dice, index == &made.rotation_track ? 4 : 3, interpolation()));
    }
    made.before[3] = {dice.number(-3, 3), dice.number(-3, 3), dice.number(-3, 3)};
    made.rotation = {dice.number(-1, 1), dice.number(-1, 1), dice.number(-1, 1), dice.number(-1, 1)};
    motion.joints.push_back(made);
  }
  return motion;
}

TEST(Motion, steps_keep_the_value_of_the_key_before) {
  const MotionTrack steps = track(Interpolation::step, 3, {1, 2, 4}, {1, 0, 0, 2, 0, 0, 3, 0, 0});
  for (const auto& [time, value] :
       {std::pair(0.0, 1.0), {0.9, 1.0}, {1.0, 1.0}, {1.99, 1.0}, {2.0, 2.0}, {3.99, 2.0}})
    EXPECT_EQ(value_at(steps, time).x, value) << time;
}

TEST(Motion, begins_again_after_its_clip) {
  const MotionTrack slides = track(Interpolation::linear, 3, {1, 3}, {10, 0, 0, 20, 0, 0});
  EXPECT_EQ(value_at(slides, 0.5).x, 10) << "before the first key";
  EXPECT_EQ(value_at(slides, 2).x, 15);
  EXPECT_EQ(value_at(slides, 3).x, 10) << "the end is the beginning";
  EXPECT_EQ(value_at(slides, 5).x, 15);
  EXPECT_EQ(value_at(slides, -1).x, 15);
  MotionTrack rests = slides;
  rests.length = 4;  // a channel of the clip that is over before the others are
  EXPECT_EQ(value_at(rests, 3.9).x, 20);
  const MotionTrack once = track(Interpolation::linear, 3, {0}, {7, 0, 0});
  EXPECT_EQ(value_at(once, 12345.6).x, 7);
}

TEST(Motion, turns_at_even_speed_along_the_shorter_way) {
  Dice dice(1);
  for (int i = 0; i < 300; ++i) {
    const auto any = [&] {
      return glm::normalize(
          glm::dquat(dice.number(-1, 1), dice.number(-1, 1), dice.number(-1, 1), dice.number(-1, 1)));
    };
    const glm::dquat a = any(), b = i % 5 == 0 ? glm::normalize(a + 1e-4 * any()) : any();
    const MotionTrack turns =
        track(Interpolation::linear, 4, {0, 1}, {a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w});
    const double share = dice.number(0, 0.999);
    const glm::dquat expected = glm::slerp(a, b, share);
    const glm::dvec4 found = value_at(turns, share);
    EXPECT_NEAR(
        std::abs(found.x * expected.x + found.y * expected.y + found.z * expected.z + found.w * expected.w),
        1, 1e-12);
    const glm::dvec4 apart = found - glm::dvec4(expected.x, expected.y, expected.z, expected.w);
    const glm::dvec4 sum = found + glm::dvec4(expected.x, expected.y, expected.z, expected.w);
    EXPECT_LT(std::min(glm::length(apart), glm::length(sum)), 1e-12);
  }
}

TEST(Motion, cubic_splines_are_those_of_the_specification) {
  const std::vector<double> values = {0, 0, 0, 1, 2, 3, 4, 5, 6, -1, 2, 0, 7, 8, 9, 0, 0, 0};
  const MotionTrack spline = track(Interpolation::cubic_spline, 3, {1, 3}, values);
  for (const double t : {0.0, 0.25, 0.5, 0.9}) {
    const double t2 = t * t, t3 = t2 * t, length = 2;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double expected = (2 * t3 - 3 * t2 + 1) * values[3 + axis] +
                              length * (t3 - 2 * t2 + t) * values[6 + axis] +
                              (-2 * t3 + 3 * t2) * values[12 + axis] + length * (t3 - t2) * values[9 + axis];
      EXPECT_NEAR(value_at(spline, 1 + length * t)[static_cast<int>(axis)], expected, 1e-12);
    }
  }
}

TEST(Motion, what_is_carried_moves_with_what_carries_it) {
  Motion motion;
  motion.tracks = {track(Interpolation::linear, 3, {0, 2}, {0, 0, 0, 4, 0, 0}),
                   track(Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0})};
  motion.joints = {{.translation_track = 0}, {.parent = 0, .rotation_track = 1, .translation = {0, 1, 0}}};
  const Affine at_half = transform_at(motion, 1, 0.5);
  EXPECT_LT(glm::distance(at_half * glm::dvec4(1, 0, 0, 1), glm::dvec3(1, 2, 0)), 1e-12)
      << "one along the way, a quarter turn, and the arm";
}

TEST(Motion, swept_boxes_hold_every_place_at_every_time) {
  const Box box{{-1, 0.5, -0.2}, {2, 1, 0.3}};
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const Motion motion = random_motion(seed);
    check_motion(motion, "random");
    for (uint32_t joint = 0; joint < motion.joints.size(); ++joint) {
      const Box swept = swept_box(motion, joint, box);
      const double stretch = largest_stretch(motion, joint);
      for (int i = 0; i < 150; ++i) {
        const Affine there = transform_at(motion, joint, 0.037 * i);
        ASSERT_TRUE(swept.contains(placed_box(there, box))) << seed << " " << joint << " " << i;
        for (int axis = 0; axis < 3; ++axis) ASSERT_LE(glm::length(there[axis]), stretch);
      }
    }
  }
}

TEST(Motion, the_swept_box_of_a_door_is_hardly_larger_than_its_way) {
  Motion motion;
  motion.tracks = {track(Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, std::sin(0.5), std::cos(0.5)})};
  motion.joints = {{.rotation_track = 0}};
  const Box swept = swept_box(motion, 0, {{0, 0, 0}, {1, 0.05, 2}});
  EXPECT_LT(swept.hi.x, 1.1);
  EXPECT_LT(swept.hi.y, 1);
  EXPECT_GT(swept.lo.y, -0.1);
  EXPECT_LT(swept.hi.z, 2.1);
}

TEST(Motion, tracks_and_joints_that_no_motion_has_are_refused) {
  const Motion good = random_motion(3);
  const auto refused = [&](const std::function<void(Motion&)>& spoil) {
    Motion motion = good;
    spoil(motion);
    try {
      check_motion(motion, "here");
    } catch (const Error& error) {
      return std::string(error.what()).starts_with("here: ");
    }
    return false;
  };
  EXPECT_FALSE(refused([](Motion&) {}));
  EXPECT_TRUE(refused([](Motion& m) { m.tracks[0].times[1] = m.tracks[0].times[0]; }));
  EXPECT_TRUE(refused([](Motion& m) { m.tracks[0].times[0] = -1; }));
  EXPECT_TRUE(refused([](Motion& m) { m.tracks[0].values.pop_back(); }));
  EXPECT_TRUE(refused([](Motion& m) { m.tracks[0].values[0] = NAN; }));
  EXPECT_TRUE(refused([](Motion& m) { m.tracks[0].length = 0; }));
  EXPECT_TRUE(refused([](Motion& m) { m.tracks[0].components = 2; }));
  EXPECT_TRUE(refused([](Motion& m) { m.tracks[0].interpolation = static_cast<Interpolation>(3); }));
  EXPECT_TRUE(refused([](Motion& m) { m.joints[1].parent = 1; }));
  EXPECT_TRUE(refused([](Motion& m) { m.joints[1].scale_track = 1000; }));
  EXPECT_TRUE(refused([](Motion& m) { m.joints[2].before[3].x = INFINITY; }));
}

}  // namespace
}  // namespace triptych
