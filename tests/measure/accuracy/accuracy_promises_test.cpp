// Holes and swaps beyond what the build promised are violations, with their place; others are not.
#include "measure/accuracy/accuracy_promises.hpp"

#include "measure/accuracy/accuracy_json.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

/// A row of a pack that kept these, whose pictures of a million surface pixels have a patch of holes and one
/// of swaps.
AccuracyRow row(const std::string& kept, uint64_t holes, uint64_t swaps) {
  AccuracyRow row;
  row.pack = "a.tpk";
  row.strategy = "occlusion";
  row.frames.resize(1);
  if (!kept.empty()) row.build = {{"keep", kept}};
  row.pictures = std::make_shared<PictureTally>();
  PictureMeasures measures{.frame = 7, .width = 1000, .height = 1000, .surface_pixels = 1'000'000};
  measures.holes = {.pixels = holes, .largest = holes, .left = 3, .bottom = 4, .right = 5, .top = 6};
  measures.swaps = measures.inner_swaps = {.pixels = swaps, .largest = swaps};
  measures.hole_at = {static_cast<double>(holes), 12, {1, 2, 3}, 4, 5};
  measures.inner_swap_at = {static_cast<double>(swaps), 13, {4, 5, 6}, 6, 7};
  row.pictures->add(measures, {}, {});
  return row;
}

AccuracyResult broken_of(std::vector<AccuracyRow> rows) {
  AccuracyResult result;
  result.rows = std::move(rows);
  find_broken_promises(result);
  return result;
}

TEST(AccuracyPromises, a_hole_in_a_pack_that_kept_what_touches_is_a_violation_with_frame_drawable_and_place) {
  const AccuracyResult result = broken_of({row("cover,touching", 2, 1000)});
  ASSERT_EQ(result.violations.size(), 1u);
  const AccuracyViolation& violation = result.violations[0];
  EXPECT_EQ(violation.frame, 7u);
  EXPECT_EQ(violation.point.drawable, 12u);
  EXPECT_EQ(violation.point.place, glm::dvec3(1, 2, 3));
  EXPECT_NE(violation.what.find("2 pixels of holes"), std::string::npos) << violation.what;
  EXPECT_NE(violation.what.find("--keep touching"), std::string::npos) << violation.what;
  EXPECT_NE(violation.what.find("at 4,5"), std::string::npos) << violation.what;
  const nlohmann::json report = accuracy_json(result);
  EXPECT_EQ(report["violations"], 1);
  EXPECT_EQ(report["violated"][0]["drawable"], 12);
  EXPECT_NE(report["rows"][0]["says"].get<std::string>().find("BREAKS THE PROMISE"), std::string::npos);
  EXPECT_EQ(report["rows"][0]["promised"]["holes"]["broken"], true);
  EXPECT_TRUE(report["rows"][0]["promised"]["swaps"]["limit_a_million"].is_null());
}

TEST(AccuracyPromises, swaps_are_promised_where_order_and_planes_were_kept) {
  EXPECT_EQ(broken_of({row("cover,order,planes,touching", 0, 20)}).violations.size(), 1u);
  EXPECT_TRUE(broken_of({row("cover,order,planes,touching", 0, 19)}).violations.empty());
  EXPECT_TRUE(broken_of({row("order", 0, 1000)}).violations.empty());
  EXPECT_TRUE(broken_of({row("planes,touching", 0, 1000)}).violations.empty());
  EXPECT_EQ(broken_of({row("cover,order,planes,touching", 0, 20)}).violations[0].point.drawable, 13u);
}

TEST(AccuracyPromises, swaps_at_edges_are_not_promised) {
  AccuracyRow edges = row("cover,order,planes,touching", 0, 0);
  PictureMeasures measures{.frame = 8, .width = 1000, .height = 1000, .surface_pixels = 1'000'000};
  measures.swaps = {.pixels = 5000, .largest = 50};
  edges.pictures->add(measures, {}, {});
  EXPECT_TRUE(broken_of({edges}).violations.empty());
  EXPECT_NE(patch_promises()[1].in_words().find("away from edges"), std::string::npos);
}

TEST(AccuracyPromises, nothing_is_promised_by_packs_that_did_not_keep_it_or_do_not_say_and_rows_say_why) {
  for (const auto& [kept, why] :
       {std::pair{"none", "built without --keep touching"}, std::pair{"", "does not say how it was built"}}) {
    const AccuracyResult result = broken_of({row(kept, 1000, 1000)});
    EXPECT_TRUE(result.violations.empty()) << kept;
    const nlohmann::json report = accuracy_json(result);
    const std::string says = report["rows"][0]["promised"]["holes"]["says"].get<std::string>();
    EXPECT_NE(says.find(why), std::string::npos) << says;
    EXPECT_EQ(report["promises"].size(), 2u);
  }
  AccuracyRow crowded = row("touching", 1000, 0);
  crowded.build["crowded-parts"] = "3";
  EXPECT_TRUE(broken_of({crowded}).violations.empty());
  EXPECT_NE(why_not_promised(patch_promises()[0], crowded).find("3 parts"), std::string::npos);
}

TEST(AccuracyPromises, what_an_approximate_strategy_loses_is_its_own) {
  AccuracyRow approximate = row("cover,order,planes,touching", 1000, 1000);
  approximate.may_miss = "what owns few pixels";
  const AccuracyResult result = broken_of({approximate});
  EXPECT_TRUE(result.violations.empty());
  const nlohmann::json report = accuracy_json(result);
  EXPECT_NE(
      report["promises"][0].get<std::string>().find("a.tpk, occlusion: holes are not promised: what this"),
      std::string::npos);
}

TEST(AccuracyPromises, rows_that_share_their_pictures_break_them_once) {
  const AccuracyRow one = row("touching", 1000, 0);
  EXPECT_EQ(broken_of({one, one}).violations.size(), 1u);
}

}  // namespace
}  // namespace triptych
