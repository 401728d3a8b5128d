#include "report/chart.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace triptych {

TEST(Chart, an_axis_ends_at_a_round_number_that_holds_the_value) {
  EXPECT_DOUBLE_EQ(axis_limit(0), 1);
  EXPECT_DOUBLE_EQ(axis_limit(10), 10);
  EXPECT_DOUBLE_EQ(axis_limit(41), 50);
  EXPECT_DOUBLE_EQ(axis_limit(0.0037), 0.004);
  for (double value = 0.001; value < 1e7; value *= 1.37) {
    EXPECT_GE(axis_limit(value), value * (1 - 1e-9));
    EXPECT_LE(axis_limit(value), 1.6 * value);
  }
}

TEST(Chart, an_axis_is_marked_in_round_steps) {
  EXPECT_EQ(axis_marks(6), (std::vector<double>{0, 2, 4, 6}));
  EXPECT_EQ(axis_marks(1).size(), 6u);
}

TEST(Chart, each_series_has_its_line_and_its_name) {
  const std::string svg = chart_svg({"ms", {{"three <processes>", {1, 2, 3}}, {"one process", {2, 2, 2}}}});
  EXPECT_NE(svg.find("three &lt;processes&gt;"), std::string::npos);
  EXPECT_NE(svg.find("<polyline class=\"series-1\""), std::string::npos);
  EXPECT_NE(svg.find("<polyline class=\"series-2\""), std::string::npos);
}

TEST(Chart, a_value_that_towers_above_the_others_is_cut_off_and_told) {
  std::vector<double> values(300, 40.0);
  values[0] = 900;
  const std::string svg = chart_svg({"ms", {{"session", values}}});
  EXPECT_NE(svg.find("1 above the scale, up to 900"), std::string::npos);
  values[0] = 41;
  EXPECT_EQ(chart_svg({"ms", {{"session", values}}}).find("above the scale"), std::string::npos);
}

TEST(Chart, magnitudes_are_evenly_apart_on_a_logarithmic_axis) {
  const std::string svg =
      chart_svg({.unit = "drawables", .series = {{"s", {1, 10, 100, 0}}}, .logarithmic = true});
  for (const char* place : {",216.0 ", ",125.0 ", ",34.0 "})
    EXPECT_NE(svg.find(place), std::string::npos) << svg;
  for (const char* mark : {">1<", ">10<", ">100<"}) EXPECT_NE(svg.find(mark), std::string::npos) << svg;
  EXPECT_EQ(svg.find(">1000<"), std::string::npos);
  for (const std::vector<double>& values : {std::vector<double>{}, {0}, {7}, {1e-3, 4e5}}) {
    const std::string other = chart_svg({.unit = "d", .series = {{"s", values}}, .logarithmic = true});
    EXPECT_EQ(other.find("nan"), std::string::npos) << other;
    EXPECT_EQ(other.find("inf"), std::string::npos) << other;
  }
}

TEST(Chart, no_values_and_a_single_one_are_drawn_without_a_nan) {
  EXPECT_EQ(chart_svg({"ms", {{"nothing", {}}}}).find("nan"), std::string::npos);
  EXPECT_EQ(chart_svg({"ms", {{"one", {3}}}}).find("nan"), std::string::npos);
}

}  // namespace triptych
