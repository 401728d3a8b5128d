// What is found wrong with pictures, on pictures made by hand.
#include "measure/accuracy/cover.hpp"
#include "measure/accuracy/holes.hpp"
#include "measure/accuracy/motion.hpp"
#include "measure/accuracy/picture_difference.hpp"
#include "measure/accuracy/pixel_deviation.hpp"
#include "measure/accuracy/reference_edges.hpp"
#include "measure/accuracy/shade_difference.hpp"
#include "measure/accuracy/surface_pixels.hpp"
#include "measure/accuracy/swaps.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <set>

namespace triptych {
namespace {

constexpr int width = 16, height = 12;

size_t at(int x, int y) { return static_cast<size_t>(y * width + x); }

/// A picture of one grey.
std::vector<uint8_t> grey(uint8_t value, int w = width, int h = height) {
  return std::vector<uint8_t>(static_cast<size_t>(4 * w * h), value);
}

void paint(std::vector<uint8_t>& picture, size_t pixel, uint8_t value) {
  std::fill_n(picture.begin() + static_cast<std::ptrdiff_t>(4 * pixel), 3, value);
}

/// Every pixel shows this drawable in this colour.
std::vector<SurfacePixel> all_of(DrawableId drawable, std::array<uint8_t, 4> color = {200, 0, 0, 255}) {
  return std::vector<SurfacePixel>(static_cast<size_t>(width * height),
                                   {.drawable = drawable, .found = true, .color = color});
}

/// A root (drawable 0) over two leaves (drawables 1 and 2).
Skeleton two_leaves() {
  Skeleton skeleton;
  skeleton.scene_nodes = {{.box = {}, .first_child = 1, .child_count = 2, .drawable_count = 1},
                          {.box = {}, .parent = 0, .first_drawable = 1, .drawable_count = 1},
                          {.box = {}, .parent = 0, .first_drawable = 2, .drawable_count = 1}};
  skeleton.drawables = {{.scene_node = 0}, {.scene_node = 1}, {.scene_node = 2}};
  return skeleton;
}

TEST(Patches, the_largest_is_found_with_its_box_and_corners_connect) {
  PixelMask mask(width, height);
  for (const auto& [x, y] : {std::pair{2, 3}, {3, 4}, {4, 3}, {15, 0}, {0, 11}}) mask.at(x, y) = 1;
  const Patches found = find_patches(mask);
  EXPECT_EQ(found.pixels, 5u);
  EXPECT_EQ(found.largest, 3u);
  EXPECT_EQ(found.left, 2);
  EXPECT_EQ(found.right, 5);
  EXPECT_EQ(found.bottom, 3);
  EXPECT_EQ(found.top, 5);
  EXPECT_EQ(find_patches(PixelMask(width, height)).largest, 0u);
}

TEST(Shades, are_compared_inside_smooth_surfaces_of_one_colour) {
  constexpr uint64_t inner = (width - 2) * (height - 2);  // the border has no neighbours
  const std::vector<SurfacePixel> surface = all_of(1);
  const auto differences = [&](const std::vector<uint8_t>& reference, const std::vector<uint8_t>& shown) {
    return shade_differences(surface, reference, surface, shown, width, height);
  };
  std::vector<uint8_t> lighter = grey(100);
  paint(lighter, at(4, 4), 130);
  EXPECT_EQ(differences(grey(100), grey(100)).mean(), 0);
  EXPECT_EQ(differences(grey(100), grey(100)).pixels(), inner);
  EXPECT_NEAR(differences(grey(100), lighter).mean(), 30.0 / inner, 1e-12);
  EXPECT_EQ(differences(grey(100), lighter).p99(), 0) << "one pixel of " << inner;
  paint(lighter, at(8, 8), 110);
  EXPECT_EQ(differences(grey(100), lighter).p99(), 10) << "a second one";
  // A fold of the reference is not smooth: neither it nor its four neighbours count.
  EXPECT_EQ(differences(lighter, lighter).pixels(), inner - 10);
  // Another colour is a swap, and no shade.
  std::vector<SurfacePixel> other = surface;
  other[at(4, 4)].color = {0, 0, 200, 255};
  EXPECT_EQ(shade_differences(surface, grey(100), other, lighter, width, height).pixels(), inner - 1);
  EXPECT_EQ(shade_differences(other, grey(100), surface, lighter, width, height).pixels(), inner - 5);
  other[at(4, 4)] = {};
  EXPECT_EQ(shade_differences(surface, grey(100), other, lighter, width, height).pixels(), inner - 1);
}

TEST(Swaps, away_from_edges_are_those_that_no_outline_can_explain) {
  Skeleton skeleton = two_leaves();
  skeleton.lattices = {Lattice{}};
  View view{.camera = {.eye = {0, 0, 0}, .target = {0, 0, -1}}, .width = width, .height = height};
  set_field_of_view(view.camera, 60, static_cast<double>(width) / height);
  const FrameView frame(skeleton, {view, 1});
  /// A wall across the line of sight; from this column on it stands so deep.
  const auto wall = [&](int column, double depth) {
    std::vector<SurfacePixel> pixels = all_of(1);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double z = x < column ? 10 : depth;
        pixels[at(x, y)].point = {z * (2 * (x + 0.5) / width - 1) * view.camera.right,
                                  z * (2 * (y + 0.5) / height - 1) * view.camera.top, -z};
      }
    }
    return pixels;
  };
  PixelMask all(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) all.at(x, y) = 1;
  }
  const auto left = [&](const std::vector<SurfacePixel>& reference, int radius) {
    return find_patches(away_from_edges(frame, reference, all, radius)).pixels;
  };
  constexpr uint64_t every = width * height;
  EXPECT_EQ(left(wall(width, 10), 2), every) << "one wall has no edge";
  EXPECT_EQ(left(wall(8, 10.5), 2), every) << "a step as deep as half a pixel is none";
  EXPECT_EQ(left(wall(8, 60), 2), every - 4 * height) << "two columns on both sides";
  EXPECT_EQ(left(wall(8, 60), 1), every - 2 * height);
  std::vector<SurfacePixel> hole = wall(width, 10);
  hole[at(5, 5)] = {};
  EXPECT_EQ(left(hole, 1), every - 9) << "the pixel and what is around it";
}

TEST(Holes, background_counts_where_the_reference_shows_surfaces_all_round) {
  std::vector<SurfacePixel> reference = all_of(1), shown = all_of(1);
  shown[at(8, 6)] = {};
  EXPECT_EQ(find_patches(find_holes(reference, shown, width, height, 2)).pixels, 1u);
  // Nearer to an outline than the radius, it may be the outline that moved.
  reference[at(10, 6)] = {};
  EXPECT_EQ(find_patches(find_holes(reference, shown, width, height, 2)).pixels, 0u);
  EXPECT_EQ(find_patches(find_holes(reference, shown, width, height, 1)).pixels, 1u);
  // At the picture's border nobody knows what is all round.
  std::vector<SurfacePixel> border = all_of(1);
  border[at(1, 6)] = {};
  EXPECT_EQ(find_patches(find_holes(all_of(1), border, width, height, 2)).pixels, 0u);
}

TEST(Swaps, another_object_or_colour_than_near_in_the_reference_counts) {
  const Skeleton skeleton = two_leaves();
  const auto swaps = [&](const std::vector<SurfacePixel>& reference, const std::vector<SurfacePixel>& shown) {
    return find_patches(find_swaps(skeleton, reference, shown, width, height, 2)).pixels;
  };
  std::vector<SurfacePixel> shown = all_of(1);
  shown[at(8, 6)].drawable = 2;  // another object
  EXPECT_EQ(swaps(all_of(1), shown), 1u);
  std::vector<SurfacePixel> reference = all_of(1);
  reference[at(10, 8)].drawable = 2;  // which is near
  EXPECT_EQ(swaps(reference, shown), 0u);
  reference[at(10, 8)].drawable = 1, reference[at(11, 6)].drawable = 2;  // which is not
  EXPECT_EQ(swaps(reference, shown), 1u);
  shown = all_of(1);
  shown[at(8, 6)].color = {0, 0, 200, 255};  // another colour
  EXPECT_EQ(swaps(all_of(1), shown), 1u);
  EXPECT_EQ(swaps(all_of(1), all_of(0)), 0u) << "the root stands for both leaves";
  EXPECT_EQ(swaps(all_of(1), all_of(0, {0, 0, 200, 255})), static_cast<uint64_t>(width * height));
}

TEST(PictureDifference, counts_pixels_and_squares_and_is_none_of_equal_pictures) {
  const PictureDifference none = picture_difference(grey(90), grey(90), width, height);
  EXPECT_EQ(none.wrong_pixels, 0u);
  EXPECT_EQ(none.squared_error, 0);
  EXPECT_EQ(none.ssim, 1);
  std::vector<uint8_t> other = grey(90);
  paint(other, 5, 93);
  other[4 * 7 + 3] = 0;  // alpha
  const PictureDifference some = picture_difference(grey(90), other, width, height);
  EXPECT_EQ(some.wrong_pixels, 1u);
  EXPECT_EQ(some.squared_error, 3 * 9);
  EXPECT_LT(some.ssim, 1);
}

TEST(StructuralSimilarity, of_even_pictures_is_the_luminance_term_and_of_opposite_ones_negative) {
  // Without variance only (2ab + c1) / (a² + b² + c1) is left.
  const double c1 = 0.01 * 255 * 0.01 * 255;
  EXPECT_NEAR(structural_similarity(grey(100), grey(150), width, height),
              (2 * 100 * 150 + c1) / (100 * 100 + 150 * 150 + c1), 1e-9);
  std::vector<uint8_t> stripes = grey(0), opposite = grey(255);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; x += 2) paint(stripes, at(x, y), 255), paint(opposite, at(x, y), 0);
  }
  EXPECT_NEAR(structural_similarity(stripes, stripes, width, height), 1, 1e-12);
  EXPECT_LT(structural_similarity(stripes, opposite, width, height), -0.9);
}

TEST(Popping, is_what_changes_beyond_the_reference_s_own_change_within_a_pixel) {
  std::vector<uint8_t> moved = grey(100);
  paint(moved, at(8, 6), 160);
  const double one = 60.0 / (width * height);
  EXPECT_NEAR(popping(grey(100), grey(100), grey(100), moved, width, height), one, 1e-12);
  std::vector<uint8_t> beside = grey(100);
  paint(beside, at(9, 7), 140);  // the reference changed by 40 next to it
  EXPECT_NEAR(popping(grey(100), beside, grey(100), moved, width, height), one / 3, 1e-12);
  EXPECT_EQ(popping(grey(100), moved, grey(100), moved, width, height), 0);
}

TEST(Flicker, is_there_and_back_within_three_frames) {
  std::vector<uint8_t> other = grey(100);
  paint(other, 3, 180), paint(other, 4, 105);
  EXPECT_EQ(flickering_pixels(grey(100), other, grey(100)), 1u);
  EXPECT_EQ(flickering_pixels(grey(100), grey(100), other), 0u);
  EXPECT_EQ(flickering_pixels(grey(100), other, other), 0u);
}

TEST(Cover, what_one_object_gains_does_not_make_up_for_what_another_loses) {
  const CoverChange cover = compare_cover({{7, 10}, {8, 4}, {9, 6}}, {{7, 5}, {8, 9}});
  EXPECT_EQ(cover.reference, 20);
  EXPECT_EQ(cover.kept, 5 + 4);
  EXPECT_EQ(cover.grown, 5);
}

TEST(Cover, shifts_stay_within_a_pixel_and_move_the_picture_by_themselves) {
  std::set<std::pair<double, double>> different;
  for (const glm::dvec2& shift : pixel_shifts(16)) {
    EXPECT_LE(std::abs(shift.x), 0.5);
    EXPECT_LE(std::abs(shift.y), 0.5);
    different.emplace(shift.x, shift.y);
  }
  EXPECT_EQ(different.size(), 16u);
  FrameState state;
  state.view.width = 100, state.view.height = 50;
  const FrameState moved = shifted(state, {0.25, -0.5});
  EXPECT_NEAR((moved.view.camera.left - state.view.camera.left) * state.view.focal_x(), 0.25, 1e-12);
  EXPECT_NEAR((moved.view.camera.top - state.view.camera.top) * state.view.focal_y(), -0.5, 1e-12);
  EXPECT_NEAR(moved.view.focal_x(), state.view.focal_x(), 1e-9);
}

TEST(SpreadPixels, none_comes_twice_and_all_come_where_all_are_wanted) {
  for (const size_t of : {1u, 2u, 96u, 512u * 512u}) {
    for (const size_t count : {size_t{1}, of / 3 + 1, of, 2 * of}) {
      const std::vector<size_t> pixels = spread_pixels(count, of);
      EXPECT_EQ(pixels.size(), std::min(count, of));
      EXPECT_EQ(std::set<size_t>(pixels.begin(), pixels.end()).size(), pixels.size());
      EXPECT_LT(pixels.back(), of);
    }
  }
}

TEST(SearchRadius, holds_the_pixel_error_and_one_pixel_more) {
  EXPECT_EQ(search_radius(0.25), 2);
  EXPECT_EQ(search_radius(1), 2);
  EXPECT_EQ(search_radius(8), 9);
}

}  // namespace
}  // namespace triptych
