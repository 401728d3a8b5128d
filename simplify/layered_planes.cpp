#include "simplify/layered_planes.hpp"

#include "simplify/key_hash.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <tsl/robin_map.h>

namespace triptych {

namespace {

/// What points may be off their plane, lattice steps: contacts are made within 16, and each surface that was
/// put on another lattice, or enlarged, was rounded once more.
constexpr double flat = 32;
constexpr double about_parallel = 0.999;  ///< cosine
constexpr double size_for_area = 2.5;     ///< LayeredPlanes::size_of(), of the area's root

using Direction = std::array<uint32_t, 3>;

Direction rounded(const glm::dvec3& normal, const glm::ivec3& beside) {
  const glm::ivec3 cell = glm::ivec3(glm::round(normal * 32.0)) + beside;
  return {static_cast<uint32_t>(cell.x), static_cast<uint32_t>(cell.y), static_cast<uint32_t>(cell.z)};
}

}  // namespace

/// Assigns triangles to planes, the largest ones first.
class LayeredPlanes::Finder {
 public:
  Finder(const Surface& surface, LayeredPlanes& result) : surface_(surface), result_(result) {}

  void run() {
    struct Candidate {
      uint32_t triangle;
      glm::dvec3 normal;
      double area;
    };
    std::vector<Candidate> candidates;
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      if (layer_of(surface_.triangles[i].material) == 0) continue;
      const glm::dvec3 doubled = glm::cross(corner(i, 1) - corner(i, 0), corner(i, 2) - corner(i, 0));
      candidates.push_back({i, glm::normalize(doubled), glm::length(doubled) / 2});
    }
    if (candidates.empty()) return;
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.area > b.area; });
    of_points_.resize(surface_.points.size());
    for (const Candidate& candidate : candidates) add(candidate.triangle, candidate.normal, candidate.area);
    for (size_t i = 0; i < areas_.size(); ++i) {
      // What lies on others; of a part that holds only what others lie on, all of it.
      const auto& areas = areas_[i];
      double upper = 0;
      for (const auto& [layer, area] : areas) {
        if (areas.size() == 1 || layer != areas.rbegin()->first) upper += area;
      }
      result_.planes_[i].size = size_for_area * std::sqrt(upper);
    }
    intern();
  }

 private:
  glm::dvec3 corner(uint32_t triangle, size_t k) const {
    return surface_.points[surface_.triangles[triangle].vertices[k]];
  }

  bool lies_in(uint32_t triangle, const glm::dvec3& normal, uint32_t plane) const {
    if (std::abs(glm::dot(normal, result_.planes_[plane].normal)) < about_parallel) return false;
    for (size_t k = 0; k < 3; ++k) {
      if (std::abs(result_.height(plane, corner(triangle, k))) > flat) return false;
    }
    return true;
  }

  /// The first plane that holds the triangle, or a new one.
  uint32_t plane_of(uint32_t triangle, const glm::dvec3& normal) {
    const auto count = static_cast<uint32_t>(result_.planes_.size());
    uint32_t plane = count;
    for (int i = 0; i < 27; ++i) {
      const auto found = by_direction_.find(rounded(normal, {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1}));
      if (found == by_direction_.end()) continue;
      for (const uint32_t other : found->second) {
        if (other < plane && lies_in(triangle, normal, other)) plane = other;
      }
    }
    if (plane < count) return plane;
    result_.planes_.push_back({corner(triangle, 0), normal, 0});
    areas_.emplace_back();
    for (const double sign : {1.0, -1.0}) by_direction_[rounded(normal * sign, {0, 0, 0})].push_back(plane);
    return plane;
  }

  void add(uint32_t triangle, const glm::dvec3& normal, double area) {
    const uint32_t plane = plane_of(triangle, normal);
    areas_[plane][layer_of(surface_.triangles[triangle].material)] += area;
    for (const uint32_t point : surface_.triangles[triangle].vertices) {
      auto& own = of_points_[point];
      if (const auto at = std::lower_bound(own.begin(), own.end(), plane); at == own.end() || *at != plane)
        own.insert(at, plane);
    }
  }

  /// Equal sets of planes get one number.
  void intern() {
    std::map<std::vector<uint32_t>, uint32_t> numbers = {{{}, 0}};
    result_.sets_ = {{}};
    for (const std::vector<uint32_t>& planes : of_points_) {
      const auto [found, inserted] = numbers.try_emplace(planes, static_cast<uint32_t>(result_.sets_.size()));
      if (inserted) result_.sets_.push_back(planes);
      result_.set_of_.push_back(found->second);
    }
  }

  const Surface& surface_;
  LayeredPlanes& result_;
  std::vector<std::map<uint32_t, double>> areas_;  ///< for each plane what lies in it, by layer
  tsl::robin_map<Direction, std::vector<uint32_t>, KeyHash, KeyEqual> by_direction_;
  std::vector<std::vector<uint32_t>> of_points_;
};

const LayeredPlanes& LayeredPlanes::none() {
  static const LayeredPlanes planes;
  return planes;
}

LayeredPlanes::LayeredPlanes(const Surface& surface) { Finder(surface, *this).run(); }

LayeredPlanes LayeredPlanes::of(std::span<const uint32_t> sources) const {
  LayeredPlanes planes;
  if (empty()) return planes;
  planes.planes_ = planes_;
  planes.sets_ = sets_;
  for (const uint32_t source : sources) planes.set_of_.push_back(set_of_[source]);
  return planes;
}

double LayeredPlanes::height(uint32_t plane, const glm::dvec3& place) const {
  return glm::dot(place - planes_[plane].point, planes_[plane].normal);
}

double LayeredPlanes::left(uint32_t point, uint32_t target) const {
  if (empty() || set_of_[point] == 0 || set_of_[point] == set_of_[target]) return 0;
  double largest = 0;
  for (const uint32_t plane : planes_of(point)) {
    if (!is_in(target, plane)) largest = std::max(largest, size_of(plane));
  }
  return largest;
}

double LayeredPlanes::entered(uint32_t point, uint32_t target, uint32_t a, uint32_t b) const {
  if (empty() || set_of_[target] == 0 || set_of_[point] == set_of_[target]) return 0;
  double largest = 0;
  for (const uint32_t plane : planes_of(target)) {
    if (is_in(a, plane) && is_in(b, plane) && !is_in(point, plane))
      largest = std::max(largest, size_of(plane));
  }
  return largest;
}

glm::dvec3 LayeredPlanes::along(uint32_t plane, const glm::dvec3& way) const {
  return way - planes_[plane].normal * glm::dot(planes_[plane].normal, way);
}

glm::dvec3 LayeredPlanes::within(uint32_t point, const glm::dvec3& way) const {
  if (empty() || set_of_[point] == 0) return way;
  glm::dvec3 kept = way;
  std::array<glm::dvec3, 2> across;  // directions that are taken away, perpendicular to each other
  size_t count = 0;
  for (const uint32_t plane : planes_of(point)) {
    glm::dvec3 normal = planes_[plane].normal;
    for (size_t k = 0; k < count; ++k) normal -= across[k] * glm::dot(across[k], normal);
    const double length = glm::length(normal);
    if (length < 1e-3) continue;
    if (count == across.size()) return glm::dvec3(0);  // three planes meet in a point
    across[count++] = normal / length;
    kept -= across[count - 1] * glm::dot(across[count - 1], kept);
  }
  return kept;
}

}  // namespace triptych
