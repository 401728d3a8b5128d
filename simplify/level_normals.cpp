#include "simplify/level_normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

/// Cosines. Normals that differ by less than a degree look the same; a triangle lies in a facet whose normal
/// is not half a degree off.
constexpr float alike = 0.99985f, in_facet = 0.99996f;
/// Corners of one smooth surface: facets meet there at no more than 40 degrees, normals of files by no more
/// than 20, since those of an edge that is meant to be seen differ.
constexpr float smooth_facets = 0.766f, smooth_corners = 0.94f;
/// What the source shows at a point has to do with the triangle: 60 degrees.
constexpr float related = 0.5f;
/// Triangles that are not so many times as wide as the level is off show no facets.
constexpr double narrow = 2;
/// So many of those that are connected are compared with the source, at most.
constexpr size_t most_compared = 64;
/// Normals of corners are worth it where the facet's own is off by a degree at least, and they by less than
/// this share of that.
constexpr float seen = 0.0175f, worth_it = 0.6f;

glm::vec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? glm::vec3(v / length) : glm::vec3(0);
}

glm::dvec3 edge(const Surface& surface, const Triangle& triangle, size_t from, size_t to) {
  return glm::dvec3(surface.points[triangle.vertices[to]]) -
         glm::dvec3(surface.points[triangle.vertices[from]]);
}

glm::vec3 facet_normal(const Surface& surface, const Triangle& triangle) {
  return unit(glm::cross(edge(surface, triangle, 0, 1), edge(surface, triangle, 0, 2)));
}

CornerNormals corner_normals_of(const std::array<glm::vec3, 3>& normals) {
  CornerNormals result;
  for (size_t k = 0; k < 3; ++k) result[k] = to_vertex_normal(glm::dvec3(normals[k]));
  return result;
}

/// How wide it is across its longest side.
double width(const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  return longest > 0 ? glm::length(glm::cross(b - a, c - a)) / longest : 0;
}

float angle_at(const Surface& surface, const Triangle& triangle, size_t corner) {
  const glm::dvec3 a = edge(surface, triangle, corner, (corner + 1) % 3),
                   b = edge(surface, triangle, corner, (corner + 2) % 3);
  return static_cast<float>(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

}  // namespace

LevelNormals::LevelNormals(const Surface& source, Facets facets)
    : source_(source), facets_(facets), first_(source.points.size() + 1, 0) {
  for (const Triangle& triangle : source.triangles) {
    for (const uint32_t point : triangle.vertices) ++first_[point + 1];
  }
  for (size_t point = 0; point + 1 < first_.size(); ++point) first_[point + 1] += first_[point];
  corners_.resize(3 * source.triangles.size());
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  for (uint32_t t = 0; t < source.triangles.size(); ++t) {
    const Triangle& triangle = source.triangles[t];
    const glm::vec3 facet = facet_normal(source, triangle);
    const bool own = !source.normals.empty() && has_normal(source.normals[t][0]);
    for (uint8_t k = 0; k < 3; ++k) {
      const glm::vec3 normal = own ? unit(direction_of(source.normals[t][k])) : facet;
      corners_[next[triangle.vertices[k]]++] = {t, k, own, normal, angle_at(source, triangle, k)};
    }
  }
}

/// The triangle of the source at these points, turned so that the first one is its first corner.
const LevelNormals::Corner* LevelNormals::find(const std::array<uint32_t, 3>& points) const {
  for (const Corner& corner : corners_at(points[0])) {
    const auto& vertices = source_.triangles[corner.triangle].vertices;
    if (vertices[(corner.number + 1u) % 3] == points[1] && vertices[(corner.number + 2u) % 3] == points[2])
      return &corner;
  }
  return nullptr;
}

/// As it is shaded.
glm::vec3 LevelNormals::normal_at(uint32_t triangle, const glm::dvec3& point) const {
  if (source_.normals.empty() || !has_normal(source_.normals[triangle][0]))
    return facet_normal(source_, source_.triangles[triangle]);
  const auto& [a, b, c] = tree_->triangle(triangle);
  const glm::dvec3 area = glm::cross(b - a, c - a), at = closest_point(point, {a, b, c});
  const double whole = glm::dot(area, area);
  const std::array weights = {glm::dot(glm::cross(c - b, at - b), area),
                              glm::dot(glm::cross(a - c, at - c), area),
                              glm::dot(glm::cross(b - a, at - a), area)};
  glm::dvec3 sum(0);
  for (size_t k = 0; k < 3; ++k)
    sum += glm::normalize(direction_of(source_.normals[triangle][k])) * (weights[k] / whole);
  return unit(sum);
}

void LevelNormals::compare(const Choice& choice, Differences& differences) {
  if (!tree_) {
    std::vector<Corners> triangles;
    for (const Triangle& own : source_.triangles) {
      const auto at = [&](size_t k) { return glm::dvec3(source_.points[own.vertices[k]]); };
      triangles.push_back({at(0), at(1), at(2)});
    }
    tree_.emplace(std::move(triangles));
  }
  constexpr double far = 2.0 / 3, near = 1.0 / 6, middle = 1.0 / 3;
  constexpr std::array<std::array<double, 3>, 4> places = {
      {{middle, middle, middle}, {far, near, near}, {near, far, near}, {near, near, far}}};
  uint32_t hint = 0;
  for (const auto& [u, v, w] : places) {
    const glm::dvec3 place = u * choice.places[0] + v * choice.places[1] + w * choice.places[2];
    hint = tree_->nearest(place, hint).triangle;
    glm::vec3 there = normal_at(hint, place);
    const float cosine = glm::dot(there, choice.facet);
    if (std::abs(cosine) < related) continue;
    if (cosine < 0) there = -there;  // both sides are lit
    const auto& [a, b, c] = choice.normals;
    const glm::vec3 mixed = unit(u * glm::dvec3(a) + v * glm::dvec3(b) + w * glm::dvec3(c));
    differences.facets += glm::length(there - choice.facet);
    differences.normals += glm::length(there - mixed);
    ++differences.count;
  }
}

bool LevelNormals::are_worth_it(std::span<const Choice> connected, double error) {
  double area = 0, wide = 0;
  for (const Choice& choice : connected) {
    area += choice.area;
    wide += choice.area * width(choice.places);
  }
  if (wide < narrow * error * area) return false;
  Differences differences;
  const size_t step = connected.size() / most_compared + 1;
  for (size_t i = 0; i < connected.size(); i += step) compare(connected[i], differences);
  return differences.facets > seen * static_cast<float>(differences.count) &&
         differences.normals < worth_it * differences.facets;
}

/// Gives the triangle what needs no comparison with the source; otherwise returns what it may have.
std::optional<LevelNormals::Choice> LevelNormals::choose(Piece& level, uint32_t index) const {
  const Triangle& triangle = level.surface.triangles[index];
  CornerNormals& own = level.surface.normals[index];
  std::array<uint32_t, 3> points;
  for (size_t k = 0; k < 3; ++k) points[k] = level.sources[triangle.vertices[k]];
  if (const Corner* const same = find(points)) {
    for (size_t k = 0; k < 3 && same->own; ++k)
      own[k] = source_.normals[same->triangle][(same->number + k) % 3];
    return std::nullopt;
  }
  Choice choice{.triangle = index,
                .places = {},
                .facet = facet_normal(level.surface, triangle),
                .normals = {},
                .area = 0};
  std::array<const Corner*, 3> nearest{};
  bool lies_in_facets = true, of_files = false;
  for (size_t k = 0; k < 3; ++k) {
    float best = related;
    for (const Corner& corner : corners_at(points[k])) {
      const float cosine = glm::dot(corner.normal, choice.facet);
      if (cosine > best || (cosine == best && !nearest[k])) {
        best = cosine;
        nearest[k] = &corner;
      }
    }
    if (!nearest[k] || (facets_ == Facets::coarse && !nearest[k]->own)) return std::nullopt;
    lies_in_facets = lies_in_facets && best > in_facet;
    of_files = of_files || (source_.file_normals && nearest[k]->own);
  }
  if (lies_in_facets) return std::nullopt;
  bool differs = false;
  for (size_t k = 0; k < 3; ++k) {
    glm::vec3 sum(0);
    for (const Corner& corner : corners_at(points[k])) {
      const float cosine = glm::dot(corner.normal, nearest[k]->normal);
      const bool smooth = cosine > (corner.own && nearest[k]->own ? smooth_corners : smooth_facets);
      if (smooth) sum += corner.normal * corner.angle;
    }
    choice.normals[k] = unit(glm::dvec3(sum));
    if (choice.normals[k] == glm::vec3(0)) return std::nullopt;
    differs = differs || glm::dot(choice.normals[k], choice.facet) < alike;
  }
  if (!differs) return std::nullopt;
  if (of_files) {
    own = corner_normals_of(choice.normals);
    return std::nullopt;
  }
  for (size_t k = 0; k < 3; ++k) choice.places[k] = glm::dvec3(level.surface.points[triangle.vertices[k]]);
  choice.area =
      glm::length(glm::cross(edge(level.surface, triangle, 0, 1), edge(level.surface, triangle, 0, 2)));
  return choice;
}

void LevelNormals::shade(Piece& level, double error) {
  level.surface.normals.assign(level.surface.triangles.size(), {});
  std::vector<Choice> choices;
  for (uint32_t i = 0; i < level.surface.triangles.size(); ++i) {
    if (auto choice = choose(level, i)) choices.push_back(*choice);
  }
  DisjointSets sets = connected_points(level.surface);
  const auto component = [&](const Choice& choice) {
    return sets.root(level.surface.triangles[choice.triangle].vertices[0]);
  };
  std::ranges::stable_sort(choices, {}, component);
  for (size_t first = 0, end = 0; first < choices.size(); first = end) {
    const size_t own = component(choices[first]);
    while (end < choices.size() && component(choices[end]) == own) ++end;
    const auto connected = std::span(choices).subspan(first, end - first);
    if (!are_worth_it(connected, error)) continue;
    for (const Choice& choice : connected)
      level.surface.normals[choice.triangle] = corner_normals_of(choice.normals);
  }
  level.surface.file_normals = source_.file_normals;
  level.surface.drop_empty_normals();
}

void drop_plain_normals(Surface& surface) {
  for (size_t t = 0; t < surface.normals.size(); ++t) {
    CornerNormals& own = surface.normals[t];
    const glm::vec3 facet = facet_normal(surface, surface.triangles[t]);
    std::array<glm::vec3, 3> normals;
    float least = 1, sum = 0;
    bool all = true;
    for (size_t k = 0; k < 3; ++k) {
      all = all && has_normal(own[k]);
      normals[k] = unit(direction_of(own[k]));
      sum += glm::dot(normals[k], facet);
    }
    for (size_t k = 0; k < 3; ++k) {
      if (sum < 0) normals[k] = -normals[k];
      least = std::min(least, glm::dot(normals[k], facet));
      if (sum < 0) own[k] = to_vertex_normal(glm::dvec3(normals[k]));
    }
    if (!all || least > alike) own = {};
  }
  surface.drop_empty_normals();
}

}  // namespace triptych
