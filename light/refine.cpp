#include "light/refine.hpp"

#include "light/sampling.hpp"
#include "light/split_edges.hpp"
#include "scene/vertex_light.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tsl/robin_set.h>

namespace triptych {

namespace {

constexpr uint32_t preview_samples = 64;
constexpr int most_rounds = 16;
/// What a triangle takes while it is refined, with its points and edges, bytes.
constexpr uint64_t bytes_a_triangle = 2 * sizeof(LitTriangle) + 200;

/// Direct light and openness on the brighter side.
struct Preview {
  glm::vec3 irradiance{0};
  float openness = 1;
};

/// An edge as the triangles on one of its sides, or both, see it.
struct SeenEdge {
  uint64_t edge;
  uint32_t from, to;       ///< points at its lower and at its higher place
  glm::vec3 to_middle{0};  ///< from the edge's middle to that of its first triangle
  bool operator<(const SeenEdge& other) const {
    return std::tie(edge, from, to) < std::tie(other.edge, other.from, other.to);
  }
  bool is_same(const SeenEdge& other) const {
    return edge == other.edge && from == other.from && to == other.to;
  }
};

class Refiner {
 public:
  Refiner(LitModel& model, const LitScene& scene, const Emitters& emitters, const LightOptions& options,
          const RunPoints& run)
      : model_(model),
        clearance_(scene.clearance()),
        gatherer_(scene, scene, emitters, options),
        options_(options),
        run_(run),
        samples_(std::min(options.samples, preview_samples)) {}

  /// Whether there was something to divide.
  bool round() {
    points_ = make_points(model_, clearance_);
    const std::vector<float> values = previews(fmt::format("light at corners, round {}", ++rounds_), points_);
    if (options_.bake && !has_white_) {
      std::vector<glm::vec3> irradiance;
      for (size_t i = 0; i < points_.size(); ++i) irradiance.push_back(at(values, i).irradiance);
      white_ = white_irradiance(model_, irradiance);
      has_white_ = true;
    }
    std::vector<uint64_t> divided;
    const std::vector<SeenEdge> seen = undecided_edges(divided);
    std::vector<LightPoint> middles;
    for (const SeenEdge& edge : seen) middles.push_back(middle_of(edge));
    const std::vector<float> there = previews(fmt::format("light along edges, round {}", rounds_), middles);
    for (size_t i = 0; i < seen.size(); ++i) {
      const Preview a = at(values, seen[i].from), b = at(values, seen[i].to);
      if (differs(at(there, i), {(a.irradiance + b.irradiance) * 0.5f, (a.openness + b.openness) * 0.5f}))
        divided.push_back(seen[i].edge);
    }
    std::ranges::sort(divided);
    divided.erase(std::unique(divided.begin(), divided.end()), divided.end());
    for (const SeenEdge& edge : seen)
      if (!std::ranges::binary_search(divided, edge.edge)) settled_.insert(edge.edge);
    split_edges(model_, divided);
    return !divided.empty();
  }

 private:
  static Preview at(const std::vector<float>& values, size_t i) {
    return {{values[4 * i], values[4 * i + 1], values[4 * i + 2]}, values[4 * i + 3]};
  }

  std::vector<float> previews(const std::string& what, std::span<const LightPoint> points) const {
    return run_(what, static_cast<uint32_t>(points.size()), [&](uint32_t i, std::vector<float>& values) {
      // The same directions everywhere: then points differ by what they see alone.
      const auto side = [&](bool back) {
        return gatherer_.direct(gather_place(points[i], back, clearance_, 1), samples_, options_.ambient);
      };
      const DirectLight front = side(false), back = side(true);
      const double gain = luminance(back.irradiance) - luminance(front.irradiance);
      const DirectLight& best = gain > 0 || (gain == 0 && is_inside(front, back)) ? back : front;
      for (int k = 0; k < 3; ++k) values.push_back(static_cast<float>(best.irradiance[k]));
      values.push_back(static_cast<float>(best.openness));
    });
  }

  /// Those that are neither short nor settled; long ones are divided anyway.
  std::vector<SeenEdge> undecided_edges(std::vector<uint64_t>& divided) const {
    const double shortest = options_.shortest_edge * model_.diagonal,
                 longest = options_.longest_edge * model_.diagonal;
    std::vector<SeenEdge> seen;
    for (const LitTriangle& triangle : model_.triangles) {
      const auto& corners = triangle.corners;
      const glm::dvec3 middle = (model_.at(corners[0]) + model_.at(corners[1]) + model_.at(corners[2])) / 3.0;
      for (size_t k = 0; k < 3; ++k) {
        const LitCorner *a = &corners[k], *b = &corners[(k + 1) % 3];
        if (a->place == b->place) continue;
        const double length = glm::distance(model_.at(*a), model_.at(*b));
        // Halves are not shorter than the shortest.
        if (length < 2 * shortest) continue;
        const uint64_t key = edge_key(a->place, b->place);
        if (length > longest) {
          divided.push_back(key);
        } else if (!settled_.contains(key)) {
          if (a->place > b->place) std::swap(a, b);
          seen.push_back(
              {key, a->point, b->point, glm::vec3(middle - (model_.at(*a) + model_.at(*b)) * 0.5)});
        }
      }
    }
    std::ranges::stable_sort(seen, {},
                             [](const SeenEdge& edge) { return std::tuple(edge.edge, edge.from, edge.to); });
    seen.erase(std::unique(seen.begin(), seen.end(), [](auto& a, auto& b) { return a.is_same(b); }),
               seen.end());
    return seen;
  }

  LightPoint middle_of(const SeenEdge& edge) const {
    const glm::dvec3 a = model_.places[edge.edge >> 32], b = model_.places[edge.edge & 0xffffffffu];
    const glm::dvec3 normals = points_[edge.from].normal + points_[edge.to].normal;
    const double length = glm::length(normals), inward = glm::length(glm::dvec3(edge.to_middle));
    LightPoint point{(a + b) * 0.5, length > 0 ? normals / length : points_[edge.from].normal, 0};
    if (inward > 0)
      point.position += glm::dvec3(edge.to_middle) * std::min(std::max(1e-3, 2 * clearance_ / inward), 0.25);
    return point;
  }

  bool differs(const Preview& a, const Preview& b) const {
    if (options_.bake && white_ > 0) {
      for (int k = 0; k < 3; ++k) {
        const auto shown = [&](float irradiance) {
          return std::sqrt(std::min(irradiance / white_, static_cast<double>(most_irradiance)));
        };
        if (std::abs(shown(a.irradiance[k]) - shown(b.irradiance[k])) > options_.threshold) return true;
      }
    }
    return options_.ambient && std::abs(a.openness - b.openness) > 2 * options_.threshold;
  }

  LitModel& model_;
  double clearance_;
  Gatherer gatherer_;
  const LightOptions& options_;
  double white_ = 0;
  const RunPoints& run_;
  uint32_t samples_;
  bool has_white_ = false;
  int rounds_ = 0;
  std::vector<LightPoint> points_;
  /// Keys that differ in few bits must not meet in the table.
  struct MixedHash {
    size_t operator()(uint64_t key) const { return static_cast<size_t>(mixed_bits(key)); }
  };
  tsl::robin_set<uint64_t, MixedHash> settled_;
};

}  // namespace

double white_irradiance(const LitModel& model, std::span<const glm::vec3> irradiance) {
  std::vector<std::pair<double, double>> lit;  // luminance and area
  double area = 0, most = 0;
  for (const LitTriangle& triangle : model.triangles) {
    double own = 0;
    for (const LitCorner& corner : triangle.corners)
      own += luminance(glm::dvec3(irradiance[corner.point])) / 3;
    lit.emplace_back(own, glm::length(model.normal(triangle)));
    most = std::max(most, own);
  }
  constexpr double dark = 1e-3;  // of the brightest
  std::erase_if(lit, [&](const auto& own) { return !(own.first > dark * most); });
  std::ranges::sort(lit);
  for (const auto& own : lit) area += own.second;
  double below = 0;
  for (const auto& [own, of_area] : lit) {
    below += of_area;
    if (below >= area / 2) return own * 5 / 3;
  }
  return 0;
}

void refine(LitModel& model, const LitScene& scene, const Emitters& emitters, const LightOptions& options,
            const RunPoints& run, LightReport& report) {
  Refiner refiner(model, scene, emitters, options, run);
  for (int i = 0; i < most_rounds; ++i) {
    if (model.triangles.size() * 4 * bytes_a_triangle > options.memory && i > 0) {
      report.warnings.push_back(
          fmt::format("light is coarser than asked for: beyond {} triangles it would not fit into --memory",
                      model.triangles.size()));
      return;
    }
    if (!refiner.round()) return;
  }
}

}  // namespace triptych
