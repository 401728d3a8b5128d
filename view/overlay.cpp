#include "view/overlay.hpp"

#include "view/stroke_font.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

constexpr glm::vec4 dark(0.05f, 0.05f, 0.08f, 1);
/// In units of the font: around words, from line to line, and from a mark to its words.
constexpr double margin = 3, line_pitch = font_height + 2, label_gap = 7;

/// Letters are 6 units wide and 10 high: 12 pixels and 20 in a window 1,080 pixels high.
double unit_of(int height, double content_scale) {
  const double halves = std::round(2 * std::max(0.5 + height / 640.0, content_scale));
  return std::clamp(halves / 2, 1.0, 8.0);
}

/// What of a text fits into so many units.
std::string fitted(const std::string& text, double width) {
  if (text_width(text) <= width) return text;
  std::string part = text;
  do {
    while (!part.empty() && (static_cast<unsigned char>(part.back()) & 0xc0) == 0x80) part.pop_back();
    if (!part.empty()) part.pop_back();
  } while (!part.empty() && text_width(part + "...") > width);
  return part + "...";
}

}  // namespace

Overlay::Overlay(const View& view, double content_scale)
    : space_(view),
      picture_(view.width, view.height),
      unit_(unit_of(view.height, content_scale)),
      width_(std::max(1, static_cast<int>(std::round(unit_ / 2)))),
      thin_(view),
      solid_(view) {}

ScreenLine Overlay::moved(const ScreenLine& line, int right, int up) const {
  const glm::vec4 shift(2.0 * right / picture_.x, 2.0 * up / picture_.y, 0, 0);
  return {line.from + shift * line.from.w, line.to + shift * line.to.w, line.color};
}

void Overlay::rim(const ScreenLine& line) {
  const int before = -(width_ / 2) - 1, behind = width_ - width_ / 2;
  for (const auto& [right, up] : {std::pair(behind, 0), {before, 0}, {0, behind}, {0, before}}) {
    rims_.push_back(moved(line, right, up));
    rims_.back().color = dark;
  }
}

/// Of lines that are nearly upright beside each other, of others above each other.
void Overlay::add_wide(std::span<const ScreenLine> lines, std::vector<ScreenLine>& all) const {
  for (const ScreenLine& line : lines) {
    const bool before_eye = line.from.w > 0 && line.to.w > 0;
    const glm::dvec2 way =
        before_eye ? picture_ * glm::dvec2(line.to / line.to.w - line.from / line.from.w) : glm::dvec2(0);
    const bool upright = std::abs(way.y) > std::abs(way.x);
    for (int i = -(width_ / 2); i < width_ - width_ / 2; ++i)
      all.push_back(moved(line, upright ? i : 0, upright ? 0 : i));
  }
}

void Overlay::keep_clear(const glm::dvec2& pixel) {
  const glm::dvec2 half(std::ceil(4 * unit_));
  shown_.push_back({pixel - half, pixel + half});
}

void Overlay::line(const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color) {
  solid_.add_line(from, to, color);
  rim(solid_.lines().back());
  const auto begin = pixel(from), end = pixel(to);
  if (!begin || !end) return;
  const glm::dvec2 way = *end - *begin;
  constexpr double most_steps = 64;
  const double steps = std::clamp(std::ceil(glm::length(way) / (8 * unit_)), 1.0, most_steps);
  for (double i = 0; i <= steps; ++i) keep_clear(*begin + way * (i / steps));
}

void Overlay::thin_line(const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color) {
  thin_.add_line(from, to, color);
}

void Overlay::box(const Box& box, const glm::vec4& color) { thin_.add_box(box, color); }

std::optional<glm::dvec2> Overlay::pixel(const glm::dvec3& at) const {
  const glm::dvec3 eye = space_.from_eye(at);
  if (-eye.z < space_.view().camera.near) return std::nullopt;
  return space_.pixel(eye);
}

ScreenLine Overlay::flat_line(const glm::dvec2& from, const glm::dvec2& to, const glm::vec4& color) const {
  const auto end = [&](const glm::dvec2& pixel) {
    return glm::vec4(2 * pixel.x / picture_.x - 1, 1 - 2 * pixel.y / picture_.y, 0.5, 1);
  };
  return {end(from), end(to), color};
}

void Overlay::stroke(const glm::dvec2& from, const glm::dvec2& to, const glm::vec4& color) {
  strokes_.push_back(flat_line(from, to, color));
  rim(strokes_.back());
}

void Overlay::mark(const glm::dvec3& at, std::span<const glm::dvec2> corners, const glm::vec4& color) {
  const auto middle = pixel(at);
  if (!middle) return;
  keep_clear(*middle);
  for (size_t i = 0; i + 1 < corners.size(); i += 2)
    stroke(*middle + unit_ * corners[i], *middle + unit_ * corners[i + 1], color);
}

void Overlay::square(const glm::dvec3& at, const glm::vec4& color) {
  constexpr std::array<glm::dvec2, 8> corners = {
      {{-4, -4}, {4, -4}, {4, -4}, {4, 4}, {4, 4}, {-4, 4}, {-4, 4}, {-4, -4}}};
  mark(at, corners, color);
}

void Overlay::cross(const glm::dvec3& at, const glm::vec4& color) {
  constexpr std::array<glm::dvec2, 4> corners = {{{-4, -4}, {4, 4}, {-4, 4}, {4, -4}}};
  mark(at, corners, color);
}

void Overlay::diamond(const glm::dvec3& at, const glm::vec4& color) {
  constexpr std::array<glm::dvec2, 8> corners = {
      {{-4, 0}, {0, -4}, {0, -4}, {4, 0}, {4, 0}, {0, 4}, {0, 4}, {-4, 0}}};
  mark(at, corners, color);
}

void Overlay::label(const glm::dvec3& at, std::vector<Words> words) {
  const auto place = pixel(at);
  if (!place || words.empty()) return;
  if (!(place->x >= 0 && place->y >= 0 && place->x <= picture_.x && place->y <= picture_.y)) return;
  labels_.push_back({*place, std::move(words)});
}

void Overlay::panel(Corner corner, const std::vector<Words>& words) {
  std::vector<Words> shown = words;
  const double edge = std::round(2 * unit_);
  double taken = edge;
  for (const ScreenBox& panel : panels_) taken += panel.hi.y - panel.lo.y + edge;
  const double lines = std::floor(((picture_.y - taken - edge) / unit_ - 2 * margin + 2) / line_pitch);
  if (lines < 1) return;
  if (static_cast<double>(shown.size()) > lines) shown.resize(static_cast<size_t>(lines));
  for (Words& line : shown) line.text = fitted(line.text, (picture_.x - 2 * edge) / unit_ - 2 * margin);
  const glm::dvec2 size = size_of(shown, unit_);
  const double top = corner == Corner::upper_left ? edge : picture_.y - edge - size.y;
  const ScreenBox box{{edge, top}, {edge + size.x, top + size.y}};
  panels_.push_back(box);
  write(box, shown, unit_, panel_lines_);
}

glm::dvec2 Overlay::letters(double unit) const {
  const glm::dvec2 room = picture_ / unit - 2 * margin;
  return glm::floor(glm::dvec2(room.x / font_advance, (room.y + 2) / line_pitch));
}

void Overlay::page(std::vector<Words> words) {
  const glm::dvec2 room = picture_ / size_of(words, 1);
  const double fits = std::floor(4 * std::min({unit_, room.x, room.y})) / 4;
  const double unit = std::max(fits, 1.0);
  for (Words& line : words) line.text = fitted(line.text, picture_.x / unit - 2 * margin);
  const ScreenBox box{glm::dvec2(0), size_of(words, unit)};
  panels_.push_back(box);
  write(box, words, unit, panel_lines_);
}

glm::dvec2 Overlay::size_of(const std::vector<Words>& words, double unit) const {
  double width = 0;
  for (const Words& line : words) width = std::max(width, text_width(line.text));
  const double height = line_pitch * static_cast<double>(words.size());
  return glm::ceil(unit * glm::dvec2(width + 2 * margin, height + 2 * margin - 2));
}

void Overlay::write(const ScreenBox& box, const std::vector<Words>& words, double unit,
                    std::vector<ScreenLine>& lines) const {
  // Through the middles of pixels, and a little beyond the last one, where OpenGL leaves out the end.
  const double left = std::floor(box.lo.x) + 0.5, right = std::ceil(box.hi.x) + 0.25;
  for (double y = std::floor(box.lo.y); y < box.hi.y; ++y)
    lines.push_back(flat_line({left, y + 0.5}, {right, y + 0.5}, dark));
  // Strokes as wide as they are thick in the font, a square of pixels at each of their places.
  const auto pen = std::max(1, static_cast<int>(std::floor(unit / 1.5 + 0.25)));
  for (size_t i = 0; i < words.size(); ++i) {
    const glm::dvec2 corner =
        glm::round(box.lo + unit * glm::dvec2(margin, margin + line_pitch * static_cast<double>(i))) + 0.5;
    for (const auto& [from, to] : strokes_of(words[i].text)) {
      const auto place = [&](const glm::dvec2& grid) {
        return corner + unit * glm::dvec2(grid.x, font_height - 1 - grid.y);
      };
      for (int k = 0; k < pen * pen; ++k) {
        const glm::dvec2 shift(k % pen, k / pen);
        lines.push_back(flat_line(place(from) + shift, place(to) + shift, words[i].color));
      }
    }
  }
}

std::vector<ScreenBox> Overlay::label_places() const {
  LabelLayout layout(picture_, label_gap * unit_);
  for (const ScreenBox& panel : panels_) layout.take(panel);
  for (const ScreenBox& shown : shown_) layout.take(shown);
  std::vector<ScreenBox> places;
  places.reserve(labels_.size());
  for (const Label& label : labels_)
    places.push_back(layout.place(label.anchor, size_of(label.words, unit_)));
  return places;
}

std::vector<ScreenLine> Overlay::lines() const {
  std::vector<ScreenLine> all;
  add_wide(thin_.lines(), all);
  all.insert(all.end(), rims_.begin(), rims_.end());
  add_wide(solid_.lines(), all);
  add_wide(strokes_, all);
  const std::vector<ScreenBox> places = label_places();
  for (size_t i = 0; i < labels_.size(); ++i) {
    const glm::dvec2 nearest = glm::clamp(labels_[i].anchor, places[i].lo, places[i].hi);
    const glm::dvec2 way = nearest - labels_[i].anchor;
    if (std::max(std::abs(way.x), std::abs(way.y)) > 2 * label_gap * unit_)
      add_wide(std::array{flat_line(labels_[i].anchor, nearest, labels_[i].words.front().color)}, all);
  }
  for (size_t i = 0; i < labels_.size(); ++i) write(places[i], labels_[i].words, unit_, all);
  all.insert(all.end(), panel_lines_.begin(), panel_lines_.end());
  return all;
}

}  // namespace triptych
