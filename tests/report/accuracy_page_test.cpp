#include "report/accuracy_page.hpp"

#include "report/scatter_chart.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <regex>

namespace triptych {
namespace {

nlohmann::json row(const std::string& strategy, double pixel_error, double ms, double deviation) {
  return {{"pack", "a.tpk"},
          {"strategy", strategy},
          {"min_pixels", nullptr},
          {"device", "cpu"},
          {"size", "512x512"},
          {"pixel_error", pixel_error},
          {"frame_ms", {{"p50", ms}, {"p95", ms}}},
          {"drawn_triangles", {{"mean", 1234}}},
          {"deviation_px", {{"max", deviation}, {"p99", deviation}}},
          {"wrong_pixel_share", 0.01},
          {"hole_share", 0.0},
          {"swap_share", 0.0},
          {"cover_kept", 0.9},
          {"popping", nullptr},
          {"rmse", 1.0},
          {"ssim", 0.99},
          {"butteraugli", nullptr},
          {"missed_triangle_share", 0.0},
          {"says", fmt::format("{:g} px: <one sentence>", pixel_error)}};
}

nlohmann::json report() {
  return {{"title", "What <it> costs"},
          {"command", "triptych measure accuracy a.tpk --path p.json -o o"},
          {"rows", {row("occlusion", 1, 2.5, 0.8), row("occlusion", 4, 1.5, 3.1)}},
          {"violations", 0},
          {"violated", nlohmann::json::array()},
          {"strip", {{{"pixel_error", 0.0}, {"frame", 7}, {"file", "pictures/full-detail.png"}}}},
          {"patches",
           {{{"kind", "hole"},
             {"row", 1},
             {"frame", 7},
             {"pixels", 12},
             {"x", 3},
             {"y", 4},
             {"reference", "pictures/r.png"},
             {"shown", "pictures/s.png"},
             {"difference", "pictures/d.png"}}}}};
}

TEST(AccuracyPage, has_sentences_charts_pictures_and_patches_and_loads_nothing_from_elsewhere) {
  const std::string page = accuracy_page(report());
  EXPECT_NE(page.find("What &lt;it&gt; costs"), std::string::npos);
  EXPECT_NE(page.find("4 px: &lt;one sentence&gt;"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_NE(page.find("pictures/full-detail.png"), std::string::npos);
  EXPECT_NE(page.find("The largest hole at 4 px of error (occlusion): 12 pixels, frame 7"),
            std::string::npos);
  EXPECT_NE(page.find("holes, pixels a million: 0 at every setting"), std::string::npos);
  EXPECT_NE(page.find("popping, of 255: not measured"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(page.find("<one"), std::string::npos);
}

TEST(AccuracyPage, names_what_was_not_kept) {
  nlohmann::json broken = report();
  broken["violations"] = 1;
  broken["violated"] = {{{"row", 1}, {"frame", 9}, {"what", "3 points deviate"}}};
  const std::string page = accuracy_page(broken);
  EXPECT_NE(page.find("Broken promises"), std::string::npos);
  EXPECT_NE(page.find("frame 9, 3 points deviate"), std::string::npos);
  EXPECT_EQ(accuracy_page(report()).find("Broken promises"), std::string::npos);
}

TEST(ScatterChart, fills_the_points_that_no_other_one_beats_and_stays_within_its_box) {
  const ScatterChart chart{"ms", "px", {{"a", {{1, 5, "x", "1"}, {2, 6, "y", "2"}, {100, 0, "z", "3"}}}}};
  const std::string svg = scatter_svg(chart);
  const std::regex best("series-1 best");
  EXPECT_EQ(std::distance(std::sregex_iterator(svg.begin(), svg.end(), best), std::sregex_iterator()), 2);
  const std::regex circle("cx=\"([^\"]*)\" cy=\"([^\"]*)\"");
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), circle); at != std::sregex_iterator(); ++at) {
    EXPECT_GE(std::stod((*at)[1]), 0);
    EXPECT_LE(std::stod((*at)[1]), 640);
    EXPECT_GE(std::stod((*at)[2]), 0);
    EXPECT_LE(std::stod((*at)[2]), 300);
  }
  EXPECT_NE(scatter_svg({"ms", "px"}).find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace triptych
