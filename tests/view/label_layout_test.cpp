// Words over pictures: where they stand, and how large they are.
#include "view/label_layout.hpp"

#include "raster/lines.hpp"
#include "view/help.hpp"
#include "view/overlay.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>

namespace triptych {
namespace {

size_t overlaps(const std::vector<ScreenBox>& boxes) {
  size_t count = 0;
  for (size_t i = 0; i < boxes.size(); ++i) {
    for (size_t k = 0; k < i; ++k) count += boxes[i].overlaps(boxes[k]);
  }
  return count;
}

TEST(LabelLayout, puts_words_to_the_right_and_away_from_what_is_there) {
  LabelLayout layout({800, 600}, 10);
  const ScreenBox first = layout.place({400, 300}, {100, 20});
  EXPECT_EQ(first, (ScreenBox{{410, 290}, {510, 310}}));
  const ScreenBox second = layout.place({400, 300}, {100, 20});
  EXPECT_EQ(second, (ScreenBox{{290, 290}, {390, 310}})) << "to the left";
  std::vector<ScreenBox> all = {first, second};
  for (int i = 0; i < 60; ++i) all.push_back(layout.place({400.0 + i % 7, 300.0 + i % 5}, {100, 20}));
  EXPECT_EQ(overlaps(all), 0u);
}

TEST(LabelLayout, keeps_words_in_the_picture) {
  LabelLayout layout({200, 100}, 5);
  for (const glm::dvec2& anchor : {glm::dvec2{199, 1}, {0, 0}, {199, 99}, {1, 99}, {100, 50}}) {
    const ScreenBox box = layout.place(anchor, {60, 15});
    EXPECT_TRUE(box.lo.x >= 0 && box.lo.y >= 0 && box.hi.x <= 200 && box.hi.y <= 100);
  }
  // Without room for all of them, each still has a place.
  for (int i = 0; i < 100; ++i) {
    const ScreenBox box = layout.place({100, 50}, {60, 15});
    EXPECT_TRUE(box.lo.x >= 0 && box.hi.x <= 200 && box.hi.y - box.lo.y == 15);
  }
}

View view_of(int width, int height) {
  View view{.camera = {.eye = {0, 0, 10}, .target = {0, 0, 0}}, .width = width, .height = height};
  set_field_of_view(view.camera, 50, static_cast<double>(width) / height);
  return view;
}

TEST(Overlay, keeps_labels_of_one_place_apart_from_each_other_and_from_panels) {
  Overlay overlay(view_of(800, 600));
  overlay.panel(Overlay::Corner::upper_left, {{"a panel"}, {std::string(1000, 'x')}});
  overlay.panel(Overlay::Corner::lower_left, {{"another"}});
  for (int i = 0; i < 12; ++i) overlay.label({0.01 * i, 0, 0}, {{"12.345 m"}, {"dx 1.0, dy 2.0"}});
  const std::vector<ScreenBox> places = overlay.label_places();
  EXPECT_EQ(places.size(), 12u);
  EXPECT_EQ(overlaps(places), 0u);
  Overlay without_panels(view_of(800, 600));
  without_panels.label({-4, 4, 0}, {{"beneath the panel"}});
  overlay.label({-4, 4, 0}, {{"beneath the panel"}});
  EXPECT_NE(overlay.label_places().back(), without_panels.label_places().back());
  for (const ScreenLine& line : overlay.lines()) {
    for (const glm::vec4& end : {line.from, line.to})
      EXPECT_TRUE(std::abs(end.x) <= end.w * 1.001f) << "what is too long for the picture is cut";
  }
}

TEST(Overlay, keeps_labels_off_marks_and_lines) {
  const View view = view_of(1400, 900);
  const PictureSpace space(view);
  const auto pixel = [&](const glm::dvec3& at) { return space.pixel(space.from_eye(at)); };
  Overlay overlay(view);
  const std::vector<glm::dvec3> corners = {{-1, 0, 0}, {1, 0.2, 0}, {1, -1, 0}, {-0.8, -1.1, 0}};
  for (size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3& from = corners[i];
    const glm::dvec3& to = corners[(i + 1) % corners.size()];
    overlay.square(from, measure_color);
    overlay.line(from, to, measure_color);
    overlay.label((from + to) * 0.5, {{"2.345 m"}});
  }
  for (const ScreenBox& place : overlay.label_places()) {
    for (size_t i = 0; i < corners.size(); ++i) {
      const glm::dvec2 from = pixel(corners[i]), to = pixel(corners[(i + 1) % corners.size()]);
      for (double share = 0; share < 1; share += 0.01) {
        const glm::dvec2 at = from + (to - from) * share;
        EXPECT_FALSE(place.overlaps({at, at + 1.0})) << "line " << i << " at " << share;
      }
    }
  }
}

TEST(Overlay, has_no_gaps_in_the_grounds_of_words) {
  for (const auto& [width, height] :
       {std::pair(640, 480), {800, 600}, {1024, 768}, {1280, 800}, {1400, 900}, {1920, 1080}}) {
    Overlay overlay(view_of(width, height));
    overlay.page({{std::string(60, ' ')}, {"."}});
    overlay.panel(Overlay::Corner::lower_left, {{std::string(30, ' ')}});
    constexpr Rgba bright = {255, 255, 255, 255};
    std::vector<Rgba> picture(static_cast<size_t>(width) * static_cast<size_t>(height), bright);
    draw_lines(overlay.lines(), width, height, picture);
    // Each row is dark from its first pixel of a ground to its last, but for the letter's own.
    size_t gaps = 0, grounds = 0;
    for (int y = 0; y < height; ++y) {
      const auto row = picture.begin() + static_cast<std::ptrdiff_t>(y) * width;
      const auto dark = [](const Rgba& color) { return color[0] < 50; };
      const auto first = std::find_if(row, row + width, dark);
      if (first == row + width) continue;
      const auto last =
          std::find_if(std::reverse_iterator(row + width), std::reverse_iterator(row), dark).base();
      ++grounds;
      const auto open = std::count_if(first, last, [&](const Rgba& color) { return !dark(color); });
      gaps += open > 8;
    }
    EXPECT_GT(grounds, 20u);
    EXPECT_EQ(gaps, 0u) << width << "x" << height;
  }
}

TEST(Overlay, is_larger_in_larger_windows_and_where_the_display_wants_it) {
  EXPECT_EQ(Overlay(view_of(320, 240)).unit(), 1);
  double before = 0;
  for (const auto& [width, height] : {std::pair(800, 600), {1920, 1080}, {3840, 2160}}) {
    const double unit = Overlay(view_of(width, height)).unit();
    EXPECT_GT(unit, before);
    before = unit;
  }
  EXPECT_GT(Overlay(view_of(800, 600), 2).unit(), Overlay(view_of(800, 600)).unit());
}

TEST(Overlay, has_lines_as_wide_as_the_window_is_high) {
  for (const auto& [width, height, wanted] :
       {std::tuple(400, 300, 1), {1920, 1080, 1}, {3840, 2160, 2}, {7680, 4320, 4}}) {
    const View view = view_of(width, height);
    Overlay overlay(view);
    EXPECT_EQ(overlay.line_width(), wanted);
    const glm::dvec3 at = view.camera.target;
    overlay.thin_line(at - glm::dvec3(1, 0.01, 0), at + glm::dvec3(1, 0.02, 0), selection_color);
    std::vector<Rgba> picture(static_cast<size_t>(width) * static_cast<size_t>(height));
    draw_lines(overlay.lines(), width, height, picture);
    int drawn = 0;
    for (int y = 0; y < height; ++y)
      drawn +=
          picture[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(width / 2)][3] >
          0;
    EXPECT_EQ(drawn, wanted) << height;
  }
}

TEST(Overlay, has_all_of_the_help_in_one_picture_or_page_by_page) {
  for (const auto& [width, height, several] :
       {std::tuple(400, 300, true), {320, 240, true}, {800, 600, false}, {1920, 1080, false}}) {
    const glm::dvec2 letters = Overlay(view_of(width, height)).letters(1);
    const auto pages = help_pages(static_cast<size_t>(letters.x), static_cast<size_t>(letters.y));
    EXPECT_EQ(pages.size() > 1, several) << width;
    std::string all;
    for (const std::vector<Words>& page : pages) {
      Overlay overlay(view_of(width, height));
      overlay.page(page);
      for (const ScreenLine& line : overlay.lines()) {
        for (const glm::vec4& end : {line.from, line.to})
          EXPECT_TRUE(std::abs(end.x) <= 1.001f && std::abs(end.y) <= 1.001f) << width;
      }
      for (const Words& line : page) all += line.text + "\n";
    }
    for (const char* const word : {"zoom to the cursor", "W A S D", "save a viewpoint (BCF)", "bird's-eye"})
      EXPECT_NE(all.find(word), std::string::npos) << word << " at " << width;
  }
}

TEST(Overlay, leaves_out_lines_of_panels_that_others_leave_no_room_for) {
  Overlay overlay(view_of(200, 100));
  overlay.panel(Overlay::Corner::upper_left, std::vector<Words>(20, Words{"a line"}));
  const size_t before = overlay.lines().size();
  overlay.panel(Overlay::Corner::lower_left, {{"over others"}});
  EXPECT_EQ(overlay.lines().size(), before);
}

}  // namespace
}  // namespace triptych
