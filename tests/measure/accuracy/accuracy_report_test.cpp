// What the figures of measure_accuracy() come to in words, advice and pictures.
#include "measure/accuracy/accuracy_advice.hpp"
#include "measure/accuracy/accuracy_json.hpp"
#include "measure/accuracy/accuracy_pictures.hpp"
#include "measure/accuracy/accuracy_words.hpp"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <png.h>

namespace triptych {
namespace {

nlohmann::json row(const std::string& strategy, double pixel_error, double ms) {
  return {{"pack", "a.tpk"},
          {"strategy", strategy},
          {"representation", "clusters"},
          {"device", "cpu"},
          {"size", "64x64"},
          {"samples", 1},
          {"min_pixels", nullptr},
          {"pixel_error", pixel_error},
          {"frame_ms", {{"p50", ms}}},
          {"deviation_px", {{"max", pixel_error / 2}}},
          {"compared_frames", 20},
          {"wrong_pixel_share", 0.01},
          {"hole_pixels", 0},
          {"hole_largest", 0},
          {"swap_pixels", 0},
          {"swap_largest", 0},
          {"swap_share", 0.0},
          {"swap_inner_share", 0.0},
          {"cover_kept", nullptr},
          {"cover_pixels", 1000.0},
          {"missed_triangle_share", 0.0}};
}

AccuracyRow empty_row() {
  AccuracyRow row;
  row.frames.resize(1);
  row.pictures = std::make_shared<PictureTally>();
  return row;
}

/// RGBA, red in the lowest byte; empty if it is no picture.
std::vector<uint32_t> pixels_of(const std::filesystem::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&image, file.c_str())) return {};
  image.format = PNG_FORMAT_RGBA;
  std::vector<uint32_t> pixels(size_t{image.width} * image.height);
  if (!png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr)) return {};
  return pixels;
}

nlohmann::json advice(const nlohmann::json& rows) {
  return accuracy_advice(rows, nlohmann::json::array()).at(0);
}

TEST(AccuracyWords, say_times_within_a_tenth_as_about_the_same) {
  EXPECT_EQ(speed_in_words(1.09), "about as fast as");
  EXPECT_EQ(speed_in_words(0.91), "about as fast as");
  EXPECT_EQ(speed_in_words(1.2), "1.2 times faster than");
  EXPECT_EQ(speed_in_words(0.5), "2.0 times slower than");
}

TEST(AccuracyWords, say_which_frames_they_were) {
  EXPECT_EQ(frames_in_words(15, 300, 20), "frames 0 to 280 of 300, every 20th");
  EXPECT_EQ(frames_in_words(100, 300, 3), "frames 0 to 297 of 300, every 3rd");
  EXPECT_EQ(frames_in_words(12, 300, 1), "frames 0 to 11 of 300, the beginning of the path");
  EXPECT_EQ(frames_in_words(300, 300, 1), "all 300 frames");
}

TEST(AccuracyWords, of_distances_are_about_the_frames_that_were_compared) {
  nlohmann::json rows = {row("occlusion", 1, 2), row("occlusion", 4, 1)};
  const std::string says = accuracy_sentence(rows[1], rows);
  EXPECT_EQ(says.find("4 px: 2.0 times faster than 1 px"), 0u) << says;
  EXPECT_NE(says.find("no surface was found off by more than 2 px in 20 compared frames"), std::string::npos);
  EXPECT_EQ(says.find("cover"), std::string::npos);
  rows[1]["cover_kept"] = 0.5;
  rows[1]["cover_pixels"] = 99;
  EXPECT_EQ(accuracy_sentence(rows[1], rows).find("cover"), std::string::npos)
      << "of so few pixels nothing is said";
  rows[1]["cover_pixels"] = 100;
  EXPECT_NE(accuracy_sentence(rows[1], rows).find("keep 50 % of their cover"), std::string::npos);
}

TEST(AccuracyAdvice, is_the_coarsest_error_that_is_good_enough_everywhere) {
  nlohmann::json rows = {row("occlusion", 0.25, 6), row("occlusion", 2, 3), row("occlusion", 4, 2),
                         row("frustum", 4, 9)};
  EXPECT_EQ(advice(rows)["pixel_error"], 4);
  EXPECT_EQ(advice(rows)["strategy"], "occlusion") << "the faster one";
  EXPECT_EQ(advice(rows)["faster"], 3);
  EXPECT_EQ(advice(rows)["says"],
            "a.tpk: take 4 px (occlusion): no holes, 0 swaps a million away from edges; 3.0 times faster "
            "than 0.25 px, the "
            "finest measured");
  EXPECT_EQ(accuracy_advice(rows, {{{"row", 2}}, {{"row", 3}}})[0]["pixel_error"], 2)
      << "promises were broken";
  rows.erase(3);
  for (const auto& [key, value] : {std::pair<const char*, nlohmann::json>{"hole_pixels", 1},
                                   {"swap_inner_share", 20e-6},
                                   {"cover_kept", 0.89}}) {
    nlohmann::json spoilt = rows;
    spoilt[2][key] = value;
    EXPECT_EQ(advice(spoilt)["pixel_error"], 2) << key;
  }
  // At another size it is not good enough.
  rows.push_back(row("occlusion", 4, 2));
  rows[3]["size"] = "128x128";
  rows[3]["hole_pixels"] = 7;
  EXPECT_EQ(advice(rows)["pixel_error"], 2);
}

TEST(AccuracyAdvice,
     takes_an_approximate_strategy_where_it_is_faster_by_a_tenth_and_says_where_nothing_will_do) {
  nlohmann::json rows = {row("occlusion", 1, 1), row("approximate", 1, 0.95)};
  rows[1]["min_pixels"] = 4;
  EXPECT_EQ(advice(rows)["strategy"], "occlusion");
  rows[1]["frame_ms"]["p50"] = 0.8;
  EXPECT_EQ(advice(rows)["strategy"], "approximate");
  for (nlohmann::json& spoilt : rows) spoilt["hole_pixels"] = 1;
  EXPECT_TRUE(advice(rows)["pixel_error"].is_null());
  EXPECT_NE(advice(rows)["says"].get<std::string>().find("measure finer ones"), std::string::npos);
}

TEST(AccuracyPictures, show_each_worst_place_once_with_all_rows_that_look_like_it) {
  AccuracyResult result;
  const std::vector<uint8_t> reference(size_t{4} * 64 * 64, 10);
  for (const int shade : {20, 20, 30}) {
    result.rows.push_back(empty_row());
    std::vector<uint8_t> shown(reference.size(), static_cast<uint8_t>(shade));
    result.rows.back().pictures->hole = {3, 7, 30, 31, 33, 32, 64, 64, reference, shown};
  }
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "triptych_worst_places";
  const nlohmann::json patches = write_accuracy_pictures(result, folder)["patches"];
  ASSERT_EQ(patches.size(), 2u);
  const std::vector<uint32_t> shown = pixels_of(folder / patches[0]["shown"].get<std::string>());
  std::filesystem::remove_all(folder);
  // A frame around 3 × 1 pixels, each as 4 × 4.
  EXPECT_EQ(std::count(shown.begin(), shown.end(), 0xffff00ffu), 2 * (12 + 2) + 2 * 4);
  EXPECT_EQ(shown.size(), size_t{192} * 192);
  EXPECT_EQ(patches[0]["rows"], nlohmann::json({0, 1}));
  EXPECT_EQ(patches[1]["rows"], nlohmann::json({2}));
  EXPECT_EQ(patches[0]["enlarged"], 4);
}

}  // namespace
}  // namespace triptych
