#include "view/measuring.hpp"

#include <cmath>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <utility>

namespace triptych {

void Measuring::begin() {
  active_ = true;
  if (!made_.points.empty()) earlier_.push_back(std::exchange(made_, {}));
}

void Measuring::end() {
  active_ = false;
  made_ = {};
  under_.reset();
  earlier_.clear();
}

std::vector<Measured> Measuring::all() const {
  std::vector<Measured> all = earlier_;
  if (active_) all.push_back(made_);
  return all;
}

void Measuring::go_on(std::vector<Measured> measured) {
  end();
  if (measured.empty()) return;
  active_ = true;
  made_ = std::move(measured.back());
  measured.pop_back();
  earlier_ = std::move(measured);
}

bool Measuring::hover(std::optional<Snap> snap) {
  const bool same = snap.has_value() == under_.has_value() &&
                    (!snap || (snap->point == under_->point && snap->kind == under_->kind));
  under_ = std::move(snap);
  return !same;
}

std::string Measuring::click(const View& view, const glm::dvec2& cursor) {
  if (made_.closed) earlier_.push_back(std::exchange(made_, {}));
  const PictureSpace space(view);
  if (made_.points.size() >= 3) {
    const glm::dvec3 first = space.from_eye(made_.points.front());
    made_.closed = -first.z >= view.camera.near && glm::distance(space.pixel(first), cursor) <= snap_pixels;
  }
  if (!made_.closed) {
    if (!under_) return "";
    made_.to_face.reset();
    if (under_->kind == SnapKind::face && !made_.points.empty())
      made_.to_face = std::abs(glm::dot(made_.points.back() - under_->point, under_->normal));
    made_.points.push_back(under_->point);
  }
  std::string text = made_.closed ? "closed" : fmt::format("point {}", made_.points.size());
  if (!made_.closed) {
    constexpr const char* kinds[] = {"corner", "edge", "face"};
    text += fmt::format(": {} ({})", place_text(under_->point), kinds[static_cast<int>(under_->kind)]);
  }
  for (const std::string& result : results(made_)) text += "\n  " + result;
  return text + "\n";
}

bool Measuring::take_back() {
  if (std::exchange(made_.closed, false)) return true;
  made_.to_face.reset();
  if (!made_.points.empty()) {
    made_.points.pop_back();
    return true;
  }
  if (earlier_.empty()) return false;
  made_ = std::move(earlier_.back());
  earlier_.pop_back();
  return true;
}

std::string Measuring::length_text(double model) const {
  return number_text(system_.own_length(model)) + " " + system_.unit;
}

std::string Measuring::area_text(double model) const {
  return number_text(system_.own_length(system_.own_length(model))) + " " + system_.unit + "²";
}

std::string Measuring::place_text(const glm::dvec3& model) const {
  const glm::dvec3 own = system_.own(model) + 0.0;  // no −0
  return fmt::format("x {:.12g}, y {:.12g}, z {:.12g} {}", own.x, own.y, own.z, system_.unit);
}

std::string Measuring::way_text(const glm::dvec3& from, const glm::dvec3& to) const {
  const glm::dvec3 own = system_.own(to - from);
  return fmt::format("dx {}, dy {}, dz {}", number_text(own.x), number_text(own.y), number_text(own.z));
}

std::vector<std::string> Measuring::results(const Measured& made) const {
  std::vector<std::string> lines;
  const std::vector<glm::dvec3>& points = made.points;
  if (points.size() < 2) return lines;
  const glm::dvec3 &last = points.back(), &before = points[points.size() - 2];
  if (made.closed) {
    const PolygonSize size = polygon_size(points);
    lines.push_back(fmt::format("area {}, perimeter {}", area_text(size.area), length_text(size.perimeter)));
    lines.push_back(fmt::format("corners up to {} off its plane", length_text(size.off_plane)));
    return lines;
  }
  lines.push_back(
      fmt::format("distance {}, {}", length_text(glm::distance(before, last)), way_text(before, last)));
  if (made.to_face)
    lines.push_back(fmt::format("{} at right angles to that face", length_text(*made.to_face)));
  if (points.size() < 3) return lines;
  lines.push_back(fmt::format("angle {:.3f}°, {} from the first point on",
                              angle_degrees(points[points.size() - 3], before, last),
                              length_text(path_length(points))));
  return lines;
}

std::string Measuring::title() const {
  if (!active_) return "";
  const std::vector<std::string> lines = results(made_);
  if (!lines.empty()) return lines.front() + (lines.size() > 1 ? ", " + lines.back() : "");
  if (made_.points.empty()) return "measuring: click a point";
  const glm::dvec3 own = system_.own(made_.points.back()) + 0.0;
  return fmt::format("x {}, y {}, z {} {}", number_text(own.x), number_text(own.y), number_text(own.z),
                     system_.unit);
}

void Measuring::draw(const Measured& made, Overlay& overlay) const {
  const std::vector<glm::dvec3>& points = made.points;
  const size_t count = points.size();
  for (size_t i = 0; i < count; ++i) {
    overlay.square(points[i], measure_color);
    if (i + 1 == count && !made.closed) continue;
    const glm::dvec3& next = points[(i + 1) % count];
    overlay.line(points[i], next, measure_color);
    std::vector<Words> words = {{length_text(glm::distance(points[i], next)), measure_color}};
    if (!made.closed && i + 2 == count) {
      words.push_back({way_text(points[i], next)});
      if (made.to_face) words.push_back({fmt::format("{} to the face", length_text(*made.to_face))});
    }
    overlay.label((points[i] + next) * 0.5, std::move(words));
  }
  for (size_t i = made.closed ? 0 : 1; i + (made.closed ? 0 : 1) < count; ++i) {
    const double degrees = angle_degrees(points[(i + count - 1) % count], points[i], points[(i + 1) % count]);
    overlay.label(points[i], {{fmt::format("{:.2f}°", degrees)}});
  }
  if (!made.closed) return;
  glm::dvec3 middle(0);
  for (const glm::dvec3& point : points) middle += (point - points[0]) / static_cast<double>(count);
  std::vector<Words> words;
  for (const std::string& result : results(made)) words.push_back({result});
  overlay.label(points[0] + middle, std::move(words));
}

void Measuring::draw(Overlay& overlay) const {
  for (const Measured& made : earlier_) draw(made, overlay);
  draw(made_, overlay);
  if (!active_ || !under_) return;
  if (!made_.points.empty() && !made_.closed) {
    const glm::dvec3& last = made_.points.back();
    overlay.line(last, under_->point, snap_color);
    if (under_->point != last)
      overlay.label(under_->point, {{length_text(glm::distance(last, under_->point)), snap_color}});
  }
  if (under_->kind == SnapKind::edge) overlay.line(under_->from, under_->to, snap_color);
  if (under_->kind == SnapKind::vertex) overlay.square(under_->point, snap_color);
  if (under_->kind == SnapKind::edge) overlay.cross(under_->point, snap_color);
  if (under_->kind == SnapKind::face) overlay.diamond(under_->point, snap_color);
}

}  // namespace triptych
