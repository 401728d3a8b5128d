// What measure_accuracy() says of packs whose every value is known, and that broken promises do not pass.
#include "measure/accuracy/accuracy.hpp"

#include "measure/accuracy/accuracy_json.hpp"
#include "measure/accuracy/holes.hpp"
#include "measure/accuracy/swaps.hpp"
#include "nodes/pack_device.hpp"
#include "nodes/picture_stage.hpp"
#include "scene/finest_boxes.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/small_pack.hpp"
#include "tests/support/test_device.hpp"
#include "visibility/strategies.hpp"

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <utility>

namespace triptych {
namespace {

using test::small_pack;
using test::SmallPack;
using test::write_pack;

/// Orthographic from above, ten pixels a unit: what deviates by δ is 10 δ pixels off, wherever it is.
std::vector<FrameRequest> from_above(size_t count = 3) {
  std::vector<FrameRequest> frames;
  for (size_t i = 0; i < count; ++i) {
    FrameRequest frame{static_cast<uint32_t>(i), {}};
    Camera& camera = frame.state.view.camera;
    camera.eye = {20 + 0.01 * static_cast<double>(i), 5, 50};
    camera.target = camera.eye - glm::dvec3(0, 0, 1);
    camera.up = {0, 1, 0};
    camera.projection = Projection::orthographic;
    camera.left = -22, camera.right = 22, camera.bottom = -8, camera.top = 8;
    frame.state.view.width = 440, frame.state.view.height = 160;
    frames.push_back(frame);
  }
  return frames;
}

AccuracyOptions options(std::vector<double> pixel_errors) {
  AccuracyOptions options;
  options.pixel_errors = std::move(pixel_errors);
  options.points = 0;
  options.shifts = 2;
  options.scratch = testing::TempDir();
  options.perceptual_frames = 0;
  for (const auto& [name, kind] : strategy_names()) {
    if (counts_pixels(kind) || kind == StrategyKind::portals) continue;
    options.strategies.push_back({name, 0, [kind = kind](const Pack&, const Hierarchy& hierarchy) {
                                    return make_strategy(kind, hierarchy);
                                  }});
  }
  return options;
}

AccuracyResult measure(const Pack& pack, const std::vector<FrameRequest>& frames,
                       const AccuracyOptions& options) {
  PackDevice device(pack, test::device());
  const AccuracySubject subject{
      "pack", device.representation().name(), pack, {{"device", device.hierarchy(), device.device()}}};
  return measure_accuracy({&subject, 1}, {&frames, 1}, options);
}

/// Leaf 1 is red and its simplification too; the root's square over it is red as well.
SmallPack colored_pack() {
  SmallPack pack = small_pack();
  pack.chunks.push_back(test::grid_chunk({0, 0, 0}, 1, 64, 0, 0));
  pack.chunk_lattices.push_back(0);
  pack.skeleton.placements[0].chunk = 3;
  pack.skeleton.placements[3].chunk = 3;
  return pack;
}

TEST(Accuracy, deviations_are_those_of_the_levels_that_are_drawn) {
  const Pack pack(write_pack(colored_pack()));
  const AccuracyResult result = measure(pack, from_above(), options({4.9, 5.1}));
  ASSERT_EQ(result.rows.size(), 6u);
  EXPECT_TRUE(result.violations.empty());
  for (const AccuracyRow& row : result.rows) {
    const PictureTally& pictures = *row.pictures;
    EXPECT_EQ(row.frames.size(), 3u);
    EXPECT_EQ(pictures.frames(), 3u);
    if (row.pixel_error < 5) {
      EXPECT_EQ(pictures.worst_deviation.point.pixels, 0) << "the source itself";
      EXPECT_EQ(pictures.wrong_pixels, 0u);
      EXPECT_EQ(pictures.ssim(), 1);
    } else {
      // The lift of 0.5 is on one side alone: the flat squares are under it.
      EXPECT_NEAR(pictures.worst_deviation.point.pixels, 5, 0.01);
      EXPECT_EQ(pictures.worst_deviation.point.drawable, 0u);
      EXPECT_GT(pictures.wrong_pixels, 0u);
    }
    EXPECT_EQ(pictures.hole_pixels, 0u);
    EXPECT_EQ(pictures.swap_pixels, 0u);
    EXPECT_EQ(row.missed_triangles, 0u);
  }
}

TEST(Accuracy, with_samples_colours_are_compared_with_a_reference_of_as_many_and_surfaces_at_centres) {
  const Pack pack(write_pack(colored_pack()));
  PackDevice device(pack, test::device());
  const AccuracySubject subject{
      "pack", device.representation().name(), pack, {{"device", device.hierarchy(), device.device()}}};
  std::vector<std::vector<FrameRequest>> paths = {from_above(), from_above()};
  for (FrameRequest& frame : paths[1]) frame.state.samples = 4;
  const AccuracyResult result = measure_accuracy({&subject, 1}, paths, options({4.9, 5.1}));
  ASSERT_EQ(result.rows.size(), 12u);
  EXPECT_TRUE(result.violations.empty());
  for (size_t row = 0; row < 6; ++row) {
    const AccuracyRow &plain = result.rows[row], &sampled = result.rows[row + 6];
    EXPECT_EQ(plain.samples, 1u);
    EXPECT_EQ(sampled.samples, 4u);
    EXPECT_EQ(sampled.pixel_error, plain.pixel_error);
    EXPECT_EQ(sampled.pictures->deviations, plain.pictures->deviations);
    EXPECT_EQ(sampled.pictures->swap_pixels, plain.pictures->swap_pixels);
    EXPECT_EQ(sampled.missed_triangles, 0u);
    if (sampled.pixel_error < 5) {
      EXPECT_EQ(sampled.pictures->wrong_pixels, 0u) << "the source itself";
    } else {
      // Outlines that lie between centres change some samples of pixels, and none at their centres.
      EXPECT_GT(sampled.pictures->wrong_pixels, plain.pictures->wrong_pixels);
    }
  }
  const nlohmann::json report = accuracy_json(result);
  EXPECT_EQ(report["rows"][0]["samples"], 1);
  EXPECT_EQ(report["rows"][11]["samples"], 4);
}

TEST(Accuracy, a_bound_that_is_two_percent_too_small_is_a_violation_with_frame_drawable_and_place) {
  SmallPack small = colored_pack();
  small.skeleton.drawables[0].error = 0.49;
  const Pack pack(write_pack(small));
  const AccuracyResult result = measure(pack, from_above(), options({4.95}));
  ASSERT_EQ(result.violations.size(), 1u) << "once, though three strategies draw it";
  const AccuracyViolation& violation = result.violations.front();
  EXPECT_EQ(violation.point.drawable, 0u);
  EXPECT_NEAR(violation.point.pixels, 5, 0.01);
  EXPECT_GE(violation.point.place.x, 0);
  EXPECT_LE(violation.point.place.x, 40);
  const nlohmann::json report = accuracy_json(result);
  EXPECT_EQ(report["violations"], 1);
  EXPECT_EQ(report["violated"][0]["drawable"], 0);
  EXPECT_NE(report["rows"][0]["says"].get<std::string>().find("BREAKS THE PROMISE"), std::string::npos);
}

TEST(Accuracy, a_hole_is_found_where_a_level_lost_a_surface) {
  SmallPack small = colored_pack();
  small.skeleton.drawables[0].placement_count = 1;  // the square of leaf 2 is gone
  small.skeleton.drawables[0].triangles = 2;
  const Pack pack(write_pack(small));
  const AccuracyResult result = measure(pack, from_above(), options({5.1}));
  const PictureTally& pictures = *result.rows.front().pictures;
  // 8 × 8 units of 10 pixels each, without a rim of the search radius.
  const double side = 80 - 2 * 7;
  EXPECT_NEAR(static_cast<double>(pictures.hole.pixels), side * side, 3 * side);
  EXPECT_EQ(pictures.swap_pixels, 0u);
  EXPECT_FALSE(result.violations.empty()) << "the way back: nothing stands for the surface";
}

TEST(Accuracy, a_hole_is_a_slit_where_what_is_shown_beside_it_covers_its_middle) {
  const Pack pack(write_pack(small_pack()));
  const PackSurfaces surfaces(pack);
  const FrameRequest frame = from_above(1).front();
  const FrameView view(pack.skeleton(), frame.state);
  PixelMask holes(frame.state.view.width, frame.state.view.height);
  std::vector<SurfacePixel> shown(holes.pixels.size(), SurfacePixel{.drawable = 0});
  const auto open = [&](int x, int y) {
    holes.at(x, y) = 1;
    shown[static_cast<size_t>(y * holes.width + x)] = {};
  };
  open(60, 70);   // the middle of the root's square over leaf 1
  open(200, 70);  // between its squares
  EXPECT_EQ(take_out_slits(surfaces, view, shown, holes), 1u);
  EXPECT_FALSE(std::as_const(holes).at(60, 70));
  EXPECT_TRUE(std::as_const(holes).at(200, 70));
}

TEST(Accuracy, what_the_full_detail_shows_between_pixels_is_no_swap) {
  const Pack pack(write_pack(small_pack()));
  const PackSurfaces surfaces(pack);
  const FrameRequest frame = from_above(1).front();
  const FrameView view(pack.skeleton(), frame.state);
  const int width = frame.state.view.width, height = frame.state.view.height;
  constexpr DrawableId red_leaf = 1;
  const SurfacePixel red = surface_pixels(surfaces, view, [&] {
    std::vector<uint32_t> items(static_cast<size_t>(width * height), 0);
    items[static_cast<size_t>(70 * width + 60)] = red_leaf + 1;
    return items;
  }())[static_cast<size_t>(70 * width + 60)];
  ASSERT_TRUE(red.found);
  const std::vector<SurfacePixel> shown(static_cast<size_t>(width * height), red);
  size_t drawn = 0;
  FinerReference finer(view, [&](const FrameView& shifted) {
    EXPECT_FALSE(shifted.view() == view.view()) << drawn;
    std::vector<uint32_t> items(static_cast<size_t>(width * height), 0);
    if (++drawn == 3) items[static_cast<size_t>(70 * width + 60)] = red_leaf + 1;
    return items;
  });
  PixelMask swaps(width, height);
  EXPECT_EQ(take_out_thin(surfaces, finer, shown, swaps, 2), 0u);
  EXPECT_EQ(drawn, 0u) << "nothing is drawn again where there are no swaps";
  swaps.at(62, 72) = 1;  // within two pixels of where the full detail shows it for a part of a pixel
  swaps.at(63, 72) = 1;  // not within them
  EXPECT_EQ(take_out_thin(surfaces, finer, shown, swaps, 2), 1u);
  EXPECT_FALSE(std::as_const(swaps).at(62, 72));
  EXPECT_TRUE(std::as_const(swaps).at(63, 72));
  EXPECT_EQ(take_out_thin(surfaces, finer, shown, swaps, 3), 1u);
  EXPECT_EQ(drawn, FinerReference::shifts) << "once a frame";
}

TEST(Accuracy, a_swap_is_found_where_a_level_shows_another_colour) {
  const Pack pack(write_pack(small_pack()));  // the root's square over the red leaf is green
  const AccuracyResult result = measure(pack, from_above(), options({5.1}));
  const PictureTally& pictures = *result.rows.front().pictures;
  EXPECT_NEAR(static_cast<double>(pictures.swap.pixels), 80 * 80, 200);
  EXPECT_EQ(pictures.hole_pixels, 0u);
  EXPECT_TRUE(result.violations.empty()) << "no distance shows it, and the pack promises nothing else";
  const Pack promising(write_pack(small_pack(), {{"keep", "order,planes"}}));
  const AccuracyResult broken = measure(promising, from_above(), options({5.1}));
  ASSERT_EQ(broken.violations.size(), 1u);
  EXPECT_NE(broken.violations[0].what.find("of swaps"), std::string::npos) << broken.violations[0].what;
  EXPECT_LT(broken.violations[0].point.place.x, 8.01) << "over the red leaf";
  EXPECT_EQ(broken.violations[0].point.drawable, 0u);
}

TEST(Accuracy, between_frames_that_do_not_follow_each_other_nothing_pops) {
  const Pack pack(write_pack(colored_pack()));
  std::vector<FrameRequest> frames = from_above();
  EXPECT_TRUE(measure(pack, frames, options({5.1})).rows.front().pictures->popping().has_value());
  for (FrameRequest& frame : frames) frame.number *= 20;
  const AccuracyResult result = measure(pack, frames, options({5.1}));
  EXPECT_FALSE(result.rows.front().pictures->popping().has_value());
  EXPECT_FALSE(result.rows.front().pictures->flicker_share().has_value());
}

TEST(Accuracy, rays_meet_what_a_device_draws) {
  const Pack& pack = scenes::pack("room");
  const PackSurfaces surfaces(pack);
  PackDevice device(pack, test::device());
  PictureStage items(device.device(), 96, 80, TargetKind::color_and_item);
  CutLister lister;
  uint64_t surface = 0, missed = 0;
  for (const View& view : scenes::random_views(pack.skeleton(), 96, 80, 20, 3)) {
    const FrameView frame(pack.skeleton(), {view, 0});
    items.begin(frame);
    items.draw(lister.list(frame));
    items.finish();
    for (const SurfacePixel& pixel : surface_pixels(surfaces, frame, items.target().read_items())) {
      if (pixel.background()) continue;
      ++surface;
      missed += !pixel.found;
      if (!pixel.found) continue;
      const double off = surfaces.distance_to_drawable(pixel.drawable, pixel.point, 0);
      EXPECT_LE(projected_distance(frame, pixel.point, off), 1e-3);
    }
  }
  EXPECT_GT(surface, 10000u);
  EXPECT_LT(static_cast<double>(missed), 0.01 * static_cast<double>(surface));
}

TEST(Accuracy, rays_meet_what_is_left_of_a_model_that_is_cut_and_hidden) {
  const Pack& pack = scenes::pack_with_objects("flat");  // without thickness, so without cut surfaces
  const PackObjects objects = pack.read_objects();
  ObjectSet every_second;
  for (SourceObjectId id = 0; id < objects.source().objects.size(); id += 2) every_second.push_back(id);
  const Hiding hiding = hide(pack.skeleton(), objects, every_second, "test");
  const PackSurfaces surfaces(pack);
  const Box box = model_box(pack.skeleton());
  PackDevice device(pack, test::device());
  PictureStage items(device.device(), 96, 80, TargetKind::color_and_item);
  CutLister lister;
  uint64_t surface = 0, missed = 0;
  for (const View& view : scenes::random_views(pack.skeleton(), 96, 80, 20, 3)) {
    FrameState state{view, 0};
    state.hiding = hiding;
    const SectionPlane side{glm::normalize(glm::dvec3(1, 0.2, 0.4)), 0};
    state.section.add_plane({side.normal, side.distance(center(box))}, "test");
    const FrameView frame(pack.skeleton(), state);
    items.begin(frame);
    items.draw(lister.list(frame));
    items.finish();
    for (const SurfacePixel& pixel : surface_pixels(surfaces, frame, items.target().read_items())) {
      if (pixel.background()) continue;
      ++surface;
      missed += !pixel.found;
      if (!pixel.found) continue;
      EXPECT_GE(state.section.planes()[0].distance(pixel.point), -1e-4 * diagonal(box));
      const double off =
          surfaces.distance_to_drawable(pixel.drawable, pixel.point, 0, nullptr, hiding.objects.get());
      EXPECT_LE(projected_distance(frame, pixel.point, off), 1e-3);
    }
  }
  EXPECT_GT(surface, 5000u);
  EXPECT_LT(static_cast<double>(missed), 0.01 * static_cast<double>(surface));
}

TEST(Accuracy, of_a_model_that_is_cut_and_hidden_keeps_its_promises) {
  const Pack& pack = scenes::pack_with_objects("room");
  const PackObjects objects = pack.read_objects();
  PackDevice device(pack, test::device());
  const Box box = model_box(pack.skeleton());
  const std::vector<View> views = scenes::random_views(pack.skeleton(), 60, 50, 8, 9);
  std::vector<FrameRequest> frames;
  for (uint32_t i = 0; i < views.size(); ++i) {
    frames.push_back({i, {views[i], 1}});
    frames.back().state.section.add_plane({{0, 0, 1}, center(box).z}, "test");
  }
  AccuracyOptions wanted = options({0.5, 4});
  wanted.compared_frames = 4;
  const auto measured = [&](const Hiding& hiding) {
    const AccuracySubject subject{.name = "pack",
                                  .representation = "levels",
                                  .pack = pack,
                                  .devices = {{"test", device.hierarchy(), device.device()}},
                                  .hiding = hiding};
    return measure_accuracy({&subject, 1}, {&frames, 1}, wanted);
  };
  const AccuracyResult whole = measured({});
  const AccuracyResult without = measured(hide(pack.skeleton(), objects, {0, 2, 4, 6, 8, 10}, "test"));
  EXPECT_TRUE(whole.violations.empty()) << whole.violations.front().what;
  EXPECT_TRUE(without.violations.empty()) << without.violations.front().what;
  EXPECT_NE(whole.pictures.front().colors, without.pictures.front().colors) << "nothing is hidden";
}

TEST(Accuracy, every_strategy_and_error_draws_what_it_promises_of_awkward_scenes) {
  for (const char* name : {"room", "instances", "storeys"}) {
    const Pack& pack = scenes::pack(name);
    std::vector<FrameRequest> frames;
    for (const View& view : scenes::path(pack.skeleton(), 64, 48, 5)) {
      if (frames.size() == 12) break;
      frames.push_back({static_cast<uint32_t>(frames.size()), {view, 1}});
    }
    const AccuracyResult result = measure(pack, frames, options({0.5, 2, 8}));
    for (const AccuracyViolation& violation : result.violations)
      ADD_FAILURE() << name << ": frame " << violation.frame << ": " << violation.what;
    EXPECT_EQ(result.rows.size(), 9u);
  }
}

TEST(Accuracy, what_an_approximate_strategy_leaves_out_is_measured_of_its_own_pictures) {
  const Pack pack(write_pack(colored_pack()));
  AccuracyOptions approximate = options({1});
  approximate.strategies = {{"approximate", 1000000, [](const Pack&, const Hierarchy& hierarchy) {
                               return make_strategy(StrategyKind::approximate, hierarchy, {{}, 1000000});
                             }}};
  std::vector<FrameRequest> frames = from_above();
  for (FrameRequest& frame : frames) {
    Camera& camera = frame.state.view.camera;
    camera.projection = Projection::perspective;
    camera.left = -0.45, camera.right = 0.45, camera.bottom = -0.17, camera.top = 0.17;
  }
  const AccuracyResult result = measure(pack, frames, approximate);
  ASSERT_EQ(result.rows.size(), 1u);
  EXPECT_NE(result.rows[0].may_miss, "");
  EXPECT_TRUE(result.violations.empty()) << "what is culled is there, only not drawn";
  EXPECT_GT(result.rows[0].missed_triangles, 0u);
  EXPECT_EQ(result.rows[0].missed_triangles, result.rows[0].owning_triangles);
  EXPECT_EQ(result.rows[0].pictures->worst_deviation.point.pixels, 0) << "culled parts count as the cut's";
  EXPECT_GT(result.rows[0].pictures->hole_pixels, 0u);
}

TEST(ProjectedDistance, is_the_largest_shift_on_the_screen_of_a_point_that_moves_so_far) {
  FrameRequest frame = from_above().front();
  Camera& camera = frame.state.view.camera;
  camera.projection = Projection::perspective;
  camera.left = -1, camera.right = 3, camera.bottom = -2, camera.top = 0.5;
  frame.state.view.width = 400, frame.state.view.height = 250;
  const Pack pack(write_pack(small_pack()));
  const FrameView view(pack.skeleton(), frame.state);
  const glm::dvec3 point{33, 2, 0.25};
  const auto seen = [&](const glm::dvec3& p) {
    const glm::dvec3 eye = view.rotation * (p - camera.eye);
    return glm::dvec2(eye.x * 100, eye.y * 100) / -eye.z;
  };
  const double distance = 1e-6;
  double largest = 0;
  for (int i = 0; i < 200; ++i) {
    for (int k = 0; k < 100; ++k) {
      const double around = 0.0314159 * i, up = 0.0314159 * k;
      const glm::dvec3 way{std::sin(up) * std::cos(around), std::sin(up) * std::sin(around), std::cos(up)};
      const glm::dvec2 shift = seen(point + distance * way) - seen(point);
      largest = std::max(largest, std::hypot(shift.x, shift.y));
    }
  }
  EXPECT_NEAR(projected_distance(view, point, distance) / largest, 1, 1e-3);
}

}  // namespace
}  // namespace triptych
