#include "view/overlay.hpp"

#include "view/stroke_font.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace triptych {

namespace {
constexpr glm::vec4 dark(0.05f, 0.05f, 0.08f, 1);
}  // namespace

Overlay::Overlay(const View& view)
    : space_(view), unit_(std::clamp(std::round(view.height / 450.0), 1.0, 4.0)), thin_(view), solid_(view) {}

void Overlay::rim(const ScreenLine& line) {
  const View& view = space_.view();
  for (const auto& [right, up] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
    const glm::vec4 shift(2.0 * right / view.width, 2.0 * up / view.height, 0, 0);
    rims_.push_back({line.from + shift * line.from.w, line.to + shift * line.to.w, dark});
  }
}

void Overlay::line(const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color) {
  solid_.add_line(from, to, color);
  rim(solid_.lines().back());
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

void Overlay::stroke(const glm::dvec2& from, const glm::dvec2& to, const glm::vec4& color) {
  const View& view = space_.view();
  const auto end = [&](const glm::dvec2& pixel) {
    return glm::vec4(2 * pixel.x / view.width - 1, 1 - 2 * pixel.y / view.height, 0.5, 1);
  };
  strokes_.push_back({end(from), end(to), color});
  rim(strokes_.back());
}

void Overlay::mark(const glm::dvec3& at, std::span<const glm::dvec2> corners, const glm::vec4& color) {
  const auto middle = pixel(at);
  if (!middle) return;
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

void Overlay::put_words(const glm::dvec2& at, std::string_view text, const glm::vec4& color) {
  for (const auto& [from, to] : strokes_of(text)) {
    const auto place = [&](const glm::dvec2& grid) {
      return at + unit_ * glm::dvec2(grid.x, font_base - grid.y);
    };
    stroke(place(from), place(to), color);
  }
}

void Overlay::words(const glm::dvec3& at, std::string_view text, const glm::vec4& color, int lines_below) {
  const auto place = pixel(at);
  if (!place) return;
  put_words(glm::round(*place + unit_ * glm::dvec2(8, -6 + (font_height + 1) * lines_below)) + 0.5, text,
            color);
}

void Overlay::banner(std::string_view text, const glm::vec4& color, int line) {
  put_words(unit_ * glm::dvec2(6, 12 + (font_height + 3) * line) + 0.5, text, color);
}

std::vector<ScreenLine> Overlay::lines() const {
  std::vector<ScreenLine> all(thin_.lines().begin(), thin_.lines().end());
  all.insert(all.end(), rims_.begin(), rims_.end());
  all.insert(all.end(), solid_.lines().begin(), solid_.lines().end());
  all.insert(all.end(), strokes_.begin(), strokes_.end());
  return all;
}

}  // namespace triptych
