#include "report/accuracy_page.hpp"

#include "report/scatter_chart.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <regex>
#include <set>

namespace triptych {
namespace {

nlohmann::json row(const std::string& strategy, double pixel_error, double ms, double deviation) {
  return {{"pack", "a.tpk"},
          {"strategy", strategy},
          {"min_pixels", nullptr},
          {"device", "cpu"},
          {"size", "512x512"},
          {"samples", 1},
          {"pixel_error", pixel_error},
          {"frame_ms", {{"p50", ms}, {"p95", ms}}},
          {"drawn_triangles", {{"mean", 1234}}},
          {"build_seconds", 2.5},
          {"pack_bytes", 3400000},
          {"deviation_px", {{"max", deviation}, {"p99", deviation}}},
          {"wrong_pixel_share", 0.01},
          {"hole_share", 0.0},
          {"swap_share", 0.0},
          {"cover_kept", 0.9},
          {"cover_pixels", 100},
          {"popping", nullptr},
          {"shade", {{"mean", 0.5}, {"p99", 4}}},
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
          {"frames_say", "frames 0 to 280 of 300, every 20th"},
          {"advice", {{{"pack", "a.tpk"}, {"says", "a.tpk: take 4 px"}}}},
          {"promises", {"a.tpk: --keep touching promises no holes"}},
          {"violations", 0},
          {"violated", nlohmann::json::array()},
          {"strip", {{{"pixel_error", 0.0}, {"frame", 7}, {"file", "pictures/full-detail.png"}}}},
          {"patches",
           {{{"kind", "hole"},
             {"row", 1},
             {"rows", {0, 1}},
             {"enlarged", 4},
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
  EXPECT_NE(
      page.find("The largest hole at 1 px of error (occlusion), at 4 px of error (occlusion): 12 pixels, "
                "frame 7"),
      std::string::npos);
  EXPECT_NE(page.find("as drawn, 4 times enlarged"), std::string::npos);
  EXPECT_NE(page.find("frames 0 to 280 of 300, every 20th"), std::string::npos);
  EXPECT_NE(page.find("<th>left out %</th>"), std::string::npos);
  EXPECT_LT(page.find("left out %: triangles in view"), page.find("<th>left out %</th>"));
  EXPECT_LT(page.find("a.tpk: take 4 px"), page.find("<h2>")) << "what to take comes first";
  EXPECT_NE(page.find("holes, pixels a million: 0 at every setting"), std::string::npos);
  EXPECT_NE(page.find("popping, of 255: not measured"), std::string::npos);
  EXPECT_NE(page.find("<li>a.tpk: --keep touching promises no holes</li>"), std::string::npos);
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

TEST(ScatterChart, wraps_the_names_of_many_series_within_its_width_and_tells_each_from_the_others) {
  ScatterChart chart{"ms", "px"};
  for (int i = 0; i < 20; ++i)
    chart.series.push_back({fmt::format("approximate {}, cpu, 512x512", i), {{1.0 + i, 1.0 + i, "", ""}}});
  chart.series.push_back({std::string(200, 'n'), {{3, 3, "", ""}}});
  const std::string svg = scatter_svg(chart);
  const std::regex name("class=\"label name\" x=\"([^\"]*)\" y=\"([^\"]*)\">([^<]*)");
  size_t letters = 0;
  double last = 0;
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), name); at != std::sregex_iterator(); ++at) {
    EXPECT_LE(std::stod((*at)[1]) + 7 * static_cast<double>((*at)[3].length()), 640);
    letters += static_cast<size_t>((*at)[3].length());
    last = std::stod((*at)[2]);
  }
  size_t wanted = 0;
  for (const ScatterSeries& series : chart.series) wanted += series.name.size();
  EXPECT_EQ(letters, wanted);
  std::smatch box;
  ASSERT_TRUE(std::regex_search(svg, box, std::regex("viewBox=\"0 0 640 ([0-9]*)\"")));
  EXPECT_GT(std::stod(box[1]), last + 220);
  std::set<std::string> styles;
  const std::regex style("<polyline ([^>]*) points");
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), style); at != std::sregex_iterator(); ++at)
    styles.insert((*at)[1]);
  EXPECT_EQ(styles.size(), chart.series.size());
}

TEST(ScatterChart, leaves_out_labels_that_would_lie_over_others) {
  const ScatterChart chart{"ms",
                           "px",
                           {{"a", {{1, 5, "first", ""}, {100, 5, "far", ""}}},
                            {"b", {{1.001, 5.001, "second", ""}, {1.002, 5.002, "third", ""}}}}};
  const std::string svg = scatter_svg(chart);
  EXPECT_NE(svg.find(">first<"), std::string::npos);
  EXPECT_NE(svg.find(">far<"), std::string::npos);
  EXPECT_NE(svg.find(">second<"), std::string::npos) << "there is room below the point";
  EXPECT_EQ(svg.find(">third<"), std::string::npos);
}

TEST(ScatterChart, has_labels_of_the_highest_points_below_the_legend) {
  for (const double highest : {2.0, 4.99, 5.0, 5.01}) {
    const std::string svg = scatter_svg({"ms", "px", {{"name", {{1, highest, "top", ""}}}}});
    std::smatch name, label;
    ASSERT_TRUE(std::regex_search(svg, name, std::regex("class=\"label name\"[^>]* y=\"([^\"]*)\"")));
    ASSERT_TRUE(std::regex_search(svg, label, std::regex("class=\"label point\"[^>]* y=\"([^\"]*)\"")));
    EXPECT_GE(std::stod(label[1]), std::stod(name[1]) + 12) << highest;
  }
}

}  // namespace
}  // namespace triptych
