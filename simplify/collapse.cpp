#include "simplify/collapse.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>

namespace triptych {

namespace {

/// Where star and fan are not both height functions along one direction, the cosine of the angle by which a
/// triangle turns may not be less than this.
constexpr double min_cosine = 0.2;
/// A factor that covers rounding.
constexpr double slack = 1 + 1e-9;

glm::dvec3 difference(const glm::ivec3& to, const glm::ivec3& from) {
  return glm::dvec3(to) - glm::dvec3(from);
}

bool holds(const ShrinkingMesh::Face& face, uint32_t point) {
  return face.corners[0] == point || face.corners[1] == point || face.corners[2] == point;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

double squared(const glm::dvec3& v) { return glm::dot(v, v); }

/// The parameter along the line from p to q at which it is nearest to the origin.
double nearest_on_line(const glm::dvec3& p, const glm::dvec3& q) {
  return -glm::dot(p, q - p) / squared(q - p);
}

}  // namespace

const Collapse* Collapser::find(ShrinkingMesh& mesh, uint32_t point, uint32_t target) {
  if (!star_.read(mesh, point)) return nullptr;
  collapse_.point = point;
  look_around(mesh);
  has_colors_ = mesh.has_colors();
  if (has_colors_) colors_.read(mesh, point, star_.spokes());
  if (target != any) return try_target(mesh, target) ? &collapse_ : nullptr;
  list_choices();
  for (size_t i = 0; i < choices_.size(); ++i) {
    // Sorted only as far as needed: nearly always the first one is taken.
    size_t best = i;
    for (size_t j = i + 1; j < choices_.size(); ++j) {
      if (choices_[j].estimate < choices_[best].estimate) best = j;
    }
    std::swap(choices_[i], choices_[best]);
    if (try_target(mesh, choices_[i].target)) return &collapse_;
  }
  return nullptr;
}

/// Computes the corners, the marks, and each fan's projection along its direction.
void Collapser::look_around(const ShrinkingMesh& mesh) {
  const auto spokes = star_.spokes();
  const glm::ivec3 origin = mesh.point(collapse_.point);
  mark_ += 2;
  from_.clear(), to_.clear(), normals_.clear(), before_.clear(), neighbours_.clear();
  for (const Star::Fan& fan : star_.fans()) {
    for (size_t i = fan.begin; i < fan.end; ++i) {
      from_.push_back(difference(mesh.point(spokes[i].from), origin));
      if (i > fan.begin) to_.push_back(from_.back());
      add_neighbour(spokes[i].from, from_.back());
      before_.push_back(spokes[i].error);
    }
    const uint32_t last = spokes[fan.end - 1].to;
    to_.push_back(fan.closed ? from_[fan.begin] : difference(mesh.point(last), origin));
    add_neighbour(last, to_.back());
  }
  for (size_t i = 0; i < spokes.size(); ++i) {
    const glm::dvec3 doubled = glm::cross(from_[i], to_[i]);
    const double length = glm::length(doubled);
    normals_.push_back({length > 0 ? doubled / length : glm::dvec3(0), length});
  }
  if (projected_.size() < star_.fans().size()) projected_.resize(star_.fans().size());
  projects_.assign(star_.fans().size(), 0);
}

void Collapser::add_neighbour(uint32_t corner, const glm::dvec3& way) {
  if (marks_[corner] == mark_) return;
  marks_[corner] = mark_;
  neighbours_.push_back({corner, way});
}

void Collapser::list_choices() {
  const auto spokes = star_.spokes();
  // The mean squared distance from the planes of the triangles, as a quadratic form.
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, area = 0;
  choices_.clear();
  for (const auto& [normal, doubled_area] : normals_) {
    const glm::dvec3 weighted = normal * doubled_area;
    xx += weighted.x * normal.x, xy += weighted.x * normal.y, xz += weighted.x * normal.z;
    yy += weighted.y * normal.y, yz += weighted.y * normal.z, zz += weighted.z * normal.z;
    area += doubled_area;
  }
  const auto estimate = [&](const glm::dvec3& d) {
    const double planes = xx * d.x * d.x + yy * d.y * d.y + zz * d.z * d.z +
                          2 * (xy * d.x * d.y + xz * d.x * d.z + yz * d.y * d.z);
    return std::max(planes, 0.0) / area + 1e-6 * squared(d);
  };
  // An open fan keeps its border where the target is an end of it and the point lies between both.
  borders_.clear();
  for (const Star::Fan& fan : star_.fans()) {
    if (fan.closed) continue;
    const glm::dvec3 &p = from_[fan.begin], &q = to_[fan.end - 1];
    const double along = nearest_on_line(p, q);
    const bool between = along > 0 && along < 1;
    borders_.push_back(
        {spokes[fan.begin].from, spokes[fan.end - 1].to, between ? squared(p + (q - p) * along) : infinity});
  }
  for (const auto& [target, d] : neighbours_) {
    double squared_distance = estimate(d);
    for (const Border& border : borders_) {
      const bool along = (border.first == target) != (border.last == target) && border.moved < infinity;
      squared_distance = std::max(squared_distance, along ? border.moved : squared(d));
    }
    if (has_colors_) {
      const double faded = glm::length(d) * colors_.difference(target);
      squared_distance = std::max(squared_distance, faded * faded);
    }
    const double left = planes_.left(collapse_.point, target);
    choices_.push_back({std::max(squared_distance, left * left), target});
  }
}

bool Collapser::try_target(ShrinkingMesh& mesh, uint32_t target) {
  if (!joins_well(mesh, target)) return false;
  collapse_.target = target;
  collapse_.beside.clear();
  collapse_.errors.assign(before_.size(), -1);
  way_ = difference(mesh.point(target), mesh.point(collapse_.point));
  length_ = glm::length(way_) * slack;
  pending_.clear();
  for (const Star::Fan& fan : star_.fans()) {
    if (!(fan.closed ? map_closed(fan, target) : map_open(fan, target)) && !move_fan(mesh, fan, target))
      return false;
    if (has_colors_) add_color_change(fan, target);
  }
  for (const auto& [spoke, error] : pending_) {
    if (!cover(mesh, star_.spokes()[spoke], target, error)) return false;
  }
  collapse_.bound = *std::max_element(collapse_.errors.begin(), collapse_.errors.end());
  for (const auto& [triangle, error] : collapse_.beside) collapse_.bound = std::max(collapse_.bound, error);
  collapse_.planes_left = planes_left(target);
  collapse_.bound = std::max(collapse_.bound, collapse_.planes_left);
  collapse_.error_before = *std::max_element(before_.begin(), before_.end());
  collapse_.cost = collapse_.bound + length_weight * length_;
  if (!sunk_.empty() && sunk_[target] && !sunk_[collapse_.point]) collapse_.cost += collapse_.bound;
  return true;
}

double Collapser::planes_left(uint32_t target) const {
  if (planes_.empty()) return 0;
  double largest = planes_.left(collapse_.point, target);
  for (const Spoke& spoke : star_.spokes()) {
    if (spoke.from != target && spoke.to != target)
      largest = std::max(largest, planes_.entered(collapse_.point, target, spoke.from, spoke.to));
  }
  return largest;
}

/// The neighbours that both ends share are the third corners of the triangles between them, and no triangle
/// of the target lies where one will be.
bool Collapser::joins_well(ShrinkingMesh& mesh, uint32_t target) {
  const uint32_t neighbour = mark_, third = mark_ + 1;
  thirds_.clear();
  for (const Spoke& spoke : star_.spokes()) {
    if (spoke.from == target) thirds_.push_back(spoke.to);
    if (spoke.to == target) thirds_.push_back(spoke.from);
  }
  for (const uint32_t corner : thirds_) marks_[corner] = third;
  marks_[target] = 0;
  const bool joins = all_fit(mesh, target, neighbour, third);
  for (const uint32_t corner : thirds_) marks_[corner] = neighbour;
  marks_[target] = neighbour;
  return joins;
}

bool Collapser::all_fit(ShrinkingMesh& mesh, uint32_t target, uint32_t neighbour, uint32_t third) const {
  // Without branches, since they could not be predicted.
  const auto fits = [&](uint32_t triangle) {
    const auto& corners = mesh.face(triangle).corners;
    const uint32_t a = marks_[corners[0]], b = marks_[corners[1]], c = marks_[corners[2]];
    return (a != neighbour) & (b != neighbour) & (c != neighbour) &
           (int{a == third} + int{b == third} + int{c == third} < 2);
  };
  // The star of a hub is large; all that matters there is also in the stars of the point's neighbours.
  if (mesh.degree(target) > Star::max_spokes) {
    size_t around = 0;
    for (const auto& [corner, way] : neighbours_) around += corner == target ? 0 : mesh.degree(corner);
    if (around < mesh.degree(target)) {
      return std::all_of(neighbours_.begin(), neighbours_.end(), [&](const Neighbour& near) {
        const uint32_t corner = near.point;
        const auto triangles = mesh.star(corner);
        return corner == target || std::all_of(triangles.begin(), triangles.end(), [&](uint32_t triangle) {
                 return !holds(mesh.face(triangle), target) || fits(triangle);
               });
      });
    }
  }
  bool all = true;
  for (const uint32_t triangle : mesh.star(target)) all &= fits(triangle);
  return all;
}

bool Collapser::map_closed(const Star::Fan& fan, uint32_t target) {
  const auto spokes = star_.spokes();
  const auto fan_index = static_cast<size_t>(&fan - star_.fans().data());
  const size_t count = fan.end - fan.begin;
  size_t apex = 0;
  while (apex < count && spokes[fan.begin + apex].from != target) ++apex;
  if (apex == count || count < 3) return false;
  ProjectedStar& projected = projected_[fan_index];
  if (projects_[fan_index] == 0) {
    glm::dvec3 direction{0};
    for (size_t i = fan.begin; i < fan.end; ++i) direction += normals_[i].direction;
    projects_[fan_index] = projected.project({from_.data() + fan.begin, count}, true, direction) ? 1 : 2;
  }
  return projects_[fan_index] == 1 &&
         projected.fan_errors(apex, {before_.data() + fan.begin, count},
                              std::span<double>(collapse_.errors).subspan(fan.begin, count));
}

bool Collapser::map_open(const Star::Fan& fan, uint32_t target) {
  const auto spokes = star_.spokes();
  const bool first = spokes[fan.begin].from == target, last = spokes[fan.end - 1].to == target;
  if (first == last) return false;
  const glm::dvec3 &p = from_[fan.begin], &q = to_[fan.end - 1];
  const double along = nearest_on_line(p, q);
  if (!(along > 1e-6 && along < 1 - 1e-6)) return false;
  const glm::dvec3 foot = p + (q - p) * along;
  const double moved = glm::length(foot) * slack;
  const size_t count = fan.end - fan.begin;
  if (count == 1) {
    pending_.push_back({fan.begin, before_[fan.begin] + moved});
    return true;
  }
  ring_.clear();
  for (size_t i = fan.begin; i < fan.end; ++i) ring_.push_back(from_[i] - foot);
  ring_.push_back(q - foot);
  glm::dvec3 direction{0};
  for (size_t i = 0; i + 1 < ring_.size(); ++i) {
    const glm::dvec3 normal = glm::cross(ring_[i], ring_[i + 1]);
    const double length = glm::length(normal);
    if (length > 0) direction += normal / length;
  }
  const auto errors = std::span<double>(collapse_.errors).subspan(fan.begin, count);
  if (!along_.project(ring_, false, direction) ||
      !along_.fan_errors(first ? 0 : count, {before_.data() + fan.begin, count}, errors)) {
    std::fill(errors.begin(), errors.end(), -1);
    return false;
  }
  for (size_t i = 0; i < count; ++i) {
    if (i != (first ? 0 : count - 1)) errors[i] += moved;
  }
  return true;
}

/// Adds what a change of colours in the fan counts to the errors of its triangles before the collapse.
void Collapser::add_color_change(const Star::Fan& fan, uint32_t target) {
  const auto [color, texture] = colors_.change(fan, target, from_, to_, way_, collapse_.errors);
  const double change = std::max(length_ * color, texture);
  if (!(change > 0)) return;
  double before = 0;
  for (size_t i = fan.begin; i < fan.end; ++i) before = std::max(before, before_[i]);
  for (size_t i = fan.begin; i < fan.end; ++i) {
    if (collapse_.errors[i] >= 0)
      collapse_.errors[i] = std::max(collapse_.errors[i], (before + change) * slack);
  }
}

/// Bounds the fan by moving the point, and with it the triangles, straight to the target: nothing moves
/// further than the point does.
bool Collapser::move_fan(ShrinkingMesh& mesh, const Star::Fan& fan, uint32_t target) {
  const auto spokes = star_.spokes();
  for (size_t i = fan.begin; i < fan.end; ++i) {
    const Spoke& spoke = spokes[i];
    if (spoke.from == target || spoke.to == target) {
      pending_.push_back({i, before_[i] + length_});
      collapse_.errors[i] = -1;
      continue;
    }
    if (degenerate(mesh.point(target), mesh.point(spoke.from), mesh.point(spoke.to))) return false;
    const glm::dvec3 after = glm::cross(from_[i] - way_, to_[i] - way_);
    if (!(glm::dot(normals_[i].direction, after) > min_cosine * glm::length(after))) return false;
    collapse_.errors[i] = before_[i] + length_;
  }
  return true;
}

/// A removed triangle became an edge of others: a triangle of its material has to be at that edge.
bool Collapser::cover(ShrinkingMesh& mesh, const Spoke& gone, uint32_t target, double error) {
  const uint32_t third = gone.from == target ? gone.to : gone.from;
  const auto spokes = star_.spokes();
  for (size_t i = 0; i < spokes.size(); ++i) {
    if (collapse_.errors[i] < 0 || spokes[i].material != gone.material) continue;
    if (spokes[i].from != third && spokes[i].to != third) continue;
    collapse_.errors[i] = std::max(collapse_.errors[i], error);
    return true;
  }
  // Both ends of the edge have the triangles at it in their stars; the smaller star is faster.
  for (const uint32_t triangle : mesh.star(mesh.degree(third) < mesh.degree(target) ? third : target)) {
    const auto& face = mesh.face(triangle);
    if (face.material != gone.material || !holds(face, third) || !holds(face, target) ||
        holds(face, collapse_.point))
      continue;
    collapse_.beside.push_back({triangle, std::max(error, face.error)});
    return true;
  }
  return false;
}

void Collapser::apply(ShrinkingMesh& mesh) {
  std::array<uint32_t, Star::max_spokes> moving;
  size_t count = 0;
  const auto spokes = star_.spokes();
  for (size_t i = 0; i < spokes.size(); ++i) {
    if (collapse_.errors[i] < 0) {
      mesh.remove(spokes[i].triangle);
    } else {
      mesh.face(spokes[i].triangle).error = collapse_.errors[i];
      if (has_colors_) mesh.set_color(spokes[i].triangle, collapse_.point, colors_.at_target(i));
      moving[count++] = spokes[i].triangle;
    }
  }
  for (const auto& [triangle, error] : collapse_.beside) {
    mesh.face(triangle).error = std::max(mesh.face(triangle).error, error);
  }
  mesh.move({moving.data(), count}, collapse_.point, collapse_.target);
}

}  // namespace triptych
