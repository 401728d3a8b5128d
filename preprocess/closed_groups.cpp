#include "preprocess/closed_groups.hpp"

#include "base/hashing.hpp"
#include "preprocess/edge_wedges.hpp"
#include "simplify/box_tree.hpp"

#include <glm/geometric.hpp>
#include <optional>
#include <tuple>

namespace triptych {

namespace {

/// Of triangles that belong to no body yet: those that hang together by edges are one, unless an edge is
/// passed more often one way than the other.
void add_balanced(const Surface& surface, ClosedTriangles& closed) {
  struct Edge {
    uint64_t key;
    uint32_t triangle;
    bool forward;
  };
  std::vector<Edge> edges;
  for (uint32_t i = 0; i < surface.triangles.size(); ++i) {
    if (closed.body_of[i] != no_id) continue;
    for (size_t k = 0; k < 3; ++k) {
      const uint64_t from = surface.triangles[i].vertices[k], to = surface.triangles[i].vertices[(k + 1) % 3];
      const auto [low, high] = std::minmax(from, to);
      edges.push_back({low << 32 | high, i, from < to});
    }
  }
  std::ranges::sort(edges, {}, [](const Edge& edge) { return std::pair(edge.key, edge.triangle); });
  DisjointSets sets(surface.triangles.size());
  std::vector<bool> open(surface.triangles.size());
  for (auto first = edges.begin(); first != edges.end();) {
    auto last = first;
    int balance = 0;
    for (; last != edges.end() && last->key == first->key; ++last) {
      sets.join(first->triangle, last->triangle);
      balance += last->forward ? 1 : -1;
    }
    if (balance != 0) open[first->triangle] = true;
    first = last;
  }
  for (uint32_t i = 0; i < open.size(); ++i) {
    if (open[i]) open[sets.root(i)] = true;
  }
  std::vector<uint32_t> numbers(open.size(), no_id);
  for (uint32_t i = 0; i < open.size(); ++i) {
    const uint32_t root = sets.root(i);
    if (closed.body_of[i] != no_id || open[root]) continue;
    if (numbers[root] == no_id) numbers[root] = closed.bodies++;
    closed.body_of[i] = numbers[root];
  }
}

}  // namespace

ClosedGroups::ClosedGroups(std::span<const glm::ivec3> points, std::span<const Corners> triangles)
    : sets_(triangles.size()), is_open_(triangles.size()) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const uint64_t from = triangles[i][k], to = triangles[i][(k + 1) % 3];
      const auto [low, high] = std::minmax(from, to);
      edges.push_back({low << 32 | high, i, triangles[i][(k + 2) % 3], from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.key < b.key; });
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::find_if(first, edges.end(), [&](const Edge& e) { return e.key != first->key; });
    if (last - first == 2 && first[0].forward != first[1].forward) {
      sets_.join(first[0].triangle, first[1].triangle);
    } else {
      join_wedges(points, {first, last});
    }
    first = last;
  }
}

void ClosedGroups::join_wedges(std::span<const glm::ivec3> points, std::span<const Edge> edges) {
  std::vector<EdgeTriangle> around;
  for (uint32_t i = 0; i < edges.size(); ++i) around.push_back({points[edges[i].apex], edges[i].forward, i});
  std::vector<bool> has_neighbour(edges.size());
  const uint64_t key = edges.front().key;
  for (const auto& [one, other] : wedges_at(points[key >> 32], points[key & 0xffffffffu], around)) {
    sets_.join(edges[one].triangle, edges[other].triangle);
    has_neighbour[one] = has_neighbour[other] = true;
  }
  for (size_t i = 0; i < edges.size(); ++i) {
    if (!has_neighbour[i]) is_open_[edges[i].triangle] = true;
  }
}

ClosedTriangles find_closed(const Surface& surface) {
  std::vector<ClosedGroups::Corners> triangles;
  triangles.reserve(surface.triangles.size());
  for (const Triangle& triangle : surface.triangles) triangles.push_back(triangle.vertices);
  ClosedTriangles closed{std::vector<uint32_t>(triangles.size(), no_id)};
  ClosedGroups(surface.points, triangles).visit([&](std::span<const uint32_t> members) {
    for (const uint32_t i : members) closed.body_of[i] = closed.bodies;
    ++closed.bodies;
  });
  add_balanced(surface, closed);
  return closed;
}

namespace {

/// Of the closed surfaces what box they have, and what volume they hold.
class Volumes {
 public:
  struct Body {
    Box box;
    double volume = 0;  ///< six times
  };

  Volumes(const Surface& surface, const ClosedTriangles& closed) : bodies_(closed.bodies) {
    std::vector<uint32_t> first(closed.bodies, no_id);
    for (uint32_t i = 0; i < surface.triangles.size(); ++i) {
      if (closed.body_of[i] == no_id) continue;
      Body& body = bodies_[closed.body_of[i]];
      uint32_t& begins = first[closed.body_of[i]];
      if (begins == no_id) begins = i;
      // From a point near by, so that nothing cancels.
      const glm::dvec3 near(surface.points[surface.triangles[begins].vertices[0]]);
      std::array<glm::dvec3, 3> from;
      for (size_t k = 0; k < 3; ++k) {
        const glm::dvec3 point(surface.points[surface.triangles[i].vertices[k]]);
        body.box.extend(point);
        from[k] = point - near;
      }
      body.volume += glm::dot(from[0], glm::cross(from[1], from[2]));
    }
    std::vector<Box> boxes;
    for (const Body& body : bodies_) boxes.push_back(body.box);
    tree_.emplace(std::move(boxes));
  }

  uint32_t count() const { return static_cast<uint32_t>(bodies_.size()); }
  bool is_inside_out(uint32_t body) const { return bodies_[body].volume < 0; }
  bool any_inside_out() const {
    return std::ranges::any_of(bodies_, [](const Body& body) { return body.volume < 0; });
  }
  /// Calls visit(other) for all whose boxes lie in the body's; of equal boxes the first one holds the others.
  template <typename Visit>
  void for_each_in(uint32_t body, const Visit& visit) const {
    const Box& box = bodies_[body].box;
    tree_->visit(box, [&](uint32_t i) {
      if (i != body && box.contains(bodies_[i].box) && (body < i || bodies_[i].box != box)) visit(i);
    });
  }

 private:
  std::vector<Body> bodies_;
  std::optional<BoxTree> tree_;
};

}  // namespace

uint64_t turn_outward(Surface& surface, const ClosedTriangles& closed) {
  const Volumes volumes(surface, closed);
  if (!volumes.any_inside_out()) return 0;
  std::vector<uint8_t> is_inner(closed.bodies), in_turned(closed.bodies), in_kept(closed.bodies);
  for (uint32_t i = 0; i < closed.bodies; ++i) volumes.for_each_in(i, [&](uint32_t k) { is_inner[k] = 1; });
  for (uint32_t i = 0; i < closed.bodies; ++i) {
    if (is_inner[i] != 0) continue;
    std::vector<uint8_t>& marks = volumes.is_inside_out(i) ? in_turned : in_kept;
    marks[i] = 1;
    volumes.for_each_in(i, [&](uint32_t k) { marks[k] = 1; });
  }
  const auto turns = [&](uint32_t body) { return in_turned[body] != 0 && in_kept[body] == 0; };
  for (uint32_t i = 0; i < surface.triangles.size(); ++i) {
    if (closed.body_of[i] == no_id || !turns(closed.body_of[i])) continue;
    std::swap(surface.triangles[i].vertices[1], surface.triangles[i].vertices[2]);
    if (!surface.colors.empty()) std::swap(surface.colors[i][1], surface.colors[i][2]);
    if (!surface.normals.empty()) std::swap(surface.normals[i][1], surface.normals[i][2]);
  }
  uint64_t turned = 0;
  for (uint32_t i = 0; i < closed.bodies; ++i) turned += turns(i);
  return turned;
}

void join_cavities(const Surface& surface, ClosedTriangles& closed) {
  const Volumes volumes(surface, closed);
  if (!volumes.any_inside_out()) return;
  DisjointSets sets(closed.bodies);
  std::vector<uint8_t> lies_in_one(closed.bodies);
  for (uint32_t i = 0; i < closed.bodies; ++i) {
    volumes.for_each_in(i, [&](uint32_t k) {
      if (!volumes.is_inside_out(k)) return;
      sets.join(i, k);
      lies_in_one[k] = 1;
    });
  }
  std::vector<uint32_t> numbers(closed.bodies, no_id);
  uint32_t count = 0;
  for (uint32_t i = 0; i < closed.bodies; ++i) {
    if (volumes.is_inside_out(i) && lies_in_one[i] == 0 && sets.root(i) == i) continue;
    uint32_t& number = numbers[sets.root(i)];
    if (number == no_id) number = count++;
  }
  for (uint32_t& body : closed.body_of) {
    if (body != no_id) body = numbers[sets.root(body)];
  }
  closed.bodies = count;
}

void EdgeSum::add(const std::array<glm::ivec3, 3>& triangle) {
  const auto key = [](const glm::ivec3& p) { return std::tuple(p.x, p.y, p.z); };
  for (size_t k = 0; k < 3; ++k) {
    const glm::ivec3 &from = triangle[k], &to = triangle[(k + 1) % 3];
    const bool forward = key(from) < key(to);
    const std::array<glm::ivec3, 2> edge = {forward ? from : to, forward ? to : from};
    const std::span<const glm::ivec3> ends(edge);
    const uint64_t low_part = hash_values(ends, 1), high_part = hash_values(ends, 2);
    low += forward ? low_part : 0 - low_part;
    high += forward ? high_part : 0 - high_part;
  }
}

}  // namespace triptych
