// The cost of frames, learnt from synthetic ones whose true cost is known.
#include "nodes/cost_model.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace triptych {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Milliseconds for one of each: a processor unlike the first guess.
constexpr CostCoefficients truth = {1, 0.5, 200e-6, 300e-6, 1e-3, 2e-3};

double true_cost(const FrameWork& work) {
  double cost = 0;
  for (size_t i = 0; i < truth.size(); ++i) cost += truth[i] * work.values()[i];
  return cost;
}

/// Frames whose terms vary independently.
class RandomWork {
 public:
  FrameWork next() {
    const auto up_to = [this](double most) { return most * uniform_(generator_); };
    return {0.25, up_to(4), up_to(1e5), up_to(5e4), up_to(1000), up_to(5000)};
  }

 private:
  std::mt19937 generator_{11};
  std::uniform_real_distribution<double> uniform_{0.05, 1};
};

TEST(CostModel, what_every_frame_costs_alike_is_learnt_term_by_term) {
  CostModel model;
  RandomWork work;
  for (int i = 0; i < 200; ++i) {
    const FrameWork frame = work.next();
    model.learn(frame, true_cost(frame));
  }
  for (int i = 0; i < 20; ++i) {
    const FrameWork frame = work.next();
    EXPECT_NEAR(model.predict(frame) / true_cost(frame), 1, 0.12);
  }
  EXPECT_NEAR(model.coefficients()[2] / truth[2], 1, 0.2) << "of a triangle";
}

TEST(CostModel, a_machine_that_turns_three_times_slower_is_followed_within_ten_frames) {
  CostModel model;
  RandomWork work;
  for (int i = 0; i < 100; ++i) {
    const FrameWork frame = work.next();
    model.learn(frame, true_cost(frame));
  }
  model.end_calibration();
  for (int i = 0; i < 10; ++i) {
    const FrameWork frame = work.next();
    model.learn(frame, 3 * true_cost(frame));
  }
  const FrameWork frame = work.next();
  EXPECT_NEAR(model.predict(frame) / (3 * true_cost(frame)), 1, 0.2);
}

TEST(CostModel, one_frame_that_was_disturbed_hardly_moves_predictions) {
  CostModel model;
  RandomWork work;
  for (int i = 0; i < 100; ++i) {
    const FrameWork frame = work.next();
    model.learn(frame, true_cost(frame));
  }
  model.end_calibration();
  const FrameWork frame = work.next();
  const double before = model.predict(frame);
  model.learn(frame, 5 * true_cost(frame));
  EXPECT_NEAR(model.predict(frame) / before, 1, 0.27);
}

TEST(CostModel, more_work_never_costs_less) {
  CostModel model;
  // Triangles and drawables rise together, and costs fall: coefficients below 0 would fit.
  for (int i = 1; i < 60; ++i) model.learn({0.25, 1, 1000.0 * i, 500.0 * i, 10.0 * i, 0}, 60.0 - i);
  for (const double coefficient : model.coefficients()) EXPECT_GE(coefficient, 0);
  EXPECT_LE(model.predict({0.25, 1, 1000, 500, 10, 0}), model.predict({0.25, 1, 50000, 25000, 500, 0}));
}

TEST(CostModel, times_and_work_that_are_no_numbers_are_ignored) {
  CostModel model, untouched;
  const FrameWork frame{0.25, 1, 1000, 500, 10, 0};
  for (const double time : {nan, infinity, -infinity, -1.0, 0.0}) model.learn(frame, time);
  model.learn({nan, 1, 1000, 500, 10, 0}, 5);
  model.learn({0.25, 1, infinity, 500, 10, 0}, 5);
  EXPECT_EQ(model.predict(frame), untouched.predict(frame));
}

TEST(CostModel, predictions_stay_finite_and_above_0_whatever_is_learnt) {
  CostModel model;
  model.end_calibration();
  for (int i = 0; i < 300; ++i) {
    model.learn({}, 5);
    model.learn({0.25, 1, 1e12, 1e11, 1e9, 1e12}, i % 2 == 0 ? 1e-5 : 1e9);
  }
  model.end_calibration();
  for (const FrameWork& frame : {FrameWork{}, FrameWork{0.25, 1, 1000, 500, 10, 0}}) {
    EXPECT_TRUE(std::isfinite(model.predict(frame)));
    EXPECT_GT(model.predict(frame), 0);
  }
}

}  // namespace
}  // namespace triptych
