#include "preprocess/check/check_surfaces.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <embree3/rtcore.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace triptych {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr uint64_t kept_triangles_limit = 4'000'000;

double squared(const glm::dvec3& v) { return glm::dot(v, v); }

/// Squared distance from the origin to the segment from a to b.
double segment_distance2(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length2 = squared(along), t = -glm::dot(a, along);
  if (!(t > 0)) return squared(a);
  return t >= length2 ? squared(b) : squared(a + (t / length2) * along);
}

/// Squared distance from the origin to the triangle, which may be degenerate.
double triangle_distance2(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, normal = glm::cross(ab, ac);
  const double area2 = squared(normal);
  const double v = glm::dot(glm::cross(ac, a), normal), w = glm::dot(glm::cross(a, ab), normal);
  if (area2 > 0 && v >= 0 && w >= 0 && v + w <= area2) {
    const double height = glm::dot(a, normal);
    return height * height / area2;
  }
  return std::min({segment_distance2(a, b), segment_distance2(b, c), segment_distance2(c, a)});
}

/// The largest singular value: the root of the largest eigenvalue of the symmetric product, in closed form.
double largest_stretch(const glm::dmat3& matrix) {
  const glm::dmat3 m = glm::transpose(matrix) * matrix;
  const double mean = (m[0][0] + m[1][1] + m[2][2]) / 3;
  const double off = m[1][0] * m[1][0] + m[2][0] * m[2][0] + m[2][1] * m[2][1];
  double spread = 2 * off;
  for (int i = 0; i < 3; ++i) spread += (m[i][i] - mean) * (m[i][i] - mean);
  const double p = std::sqrt(spread / 6);
  if (!(p > 0)) return std::sqrt(mean);
  const glm::dmat3 scaled = (m - glm::dmat3(mean)) / p;
  const double angle = std::acos(std::clamp(glm::determinant(scaled) / 2, -1.0, 1.0)) / 3;
  return std::sqrt(mean + 2 * p * std::cos(angle));
}

/// Rounds up, so that a float search never misses what a double search would find.
float upward(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

double distance_to_box(const glm::dvec3& point, const Box& box) {
  return glm::length(glm::max(glm::max(box.lo - point, point - box.hi), glm::dvec3(0)));
}

struct Search {
  const std::vector<glm::dvec3>* positions;
  const std::vector<uint32_t>* indices;
  const Placing* placing;
  glm::dvec3 point;  ///< less the translation
  double best, floor, margin;
  double unit;  ///< of the tree's floats
};

bool visit_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<Search*>(arguments->userPtr);
  std::array<glm::dvec3, 3> corners;
  for (size_t k = 0; k < 3; ++k) {
    const uint32_t vertex = (*search.indices)[3 * size_t{arguments->primID} + k];
    corners[k] = search.placing->linear * (*search.positions)[vertex] - search.point;
  }
  const double distance2 = triangle_distance2(corners[0], corners[1], corners[2]);
  if (!(distance2 < search.best * search.best)) return false;
  const double distance = std::min(std::sqrt(distance2), search.best);
  search.best = distance;
  if (distance <= search.floor) {
    arguments->query->radius = 0;
    return true;
  }
  const double radius = distance * search.placing->stretch + search.margin;
  if (!std::isfinite(radius)) return false;
  arguments->query->radius = upward(radius / search.unit);
  return true;
}

}  // namespace

double distance_to_triangle(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& c) {
  return std::sqrt(triangle_distance2(a - point, b - point, c - point));
}

Placing::Placing(const Affine& affine) : transform(affine), linear(affine), inverse(1), stretch(infinite) {
  const glm::dmat3 candidate = glm::inverse(linear);
  const double largest = largest_stretch(candidate) * (1 + 1e-9);
  if (!std::isfinite(largest)) return;
  inverse = candidate;
  stretch = largest;
}

ChunkTree::ChunkTree(RTCDeviceTy* device, const Chunk& chunk, const Lattice& lattice)
    : scene_(rtcNewScene(device)), indices_(chunk.indices) {
  const Box box = lattice.box(chunk.box());
  center_ = (box.lo + box.hi) * 0.5;
  extent_ = diagonal(box);
  if (extent_ > 0) unit_ = std::exp2(std::ilogb(extent_));
  positions_.reserve(chunk.vertices.size());
  for (const ChunkVertex& vertex : chunk.vertices) positions_.push_back(lattice.position(vertex.point));
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* floats = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), positions_.size()));
  auto* triangles = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), triangle_count()));
  for (size_t i = 0; i < positions_.size(); ++i) {
    const glm::dvec3 local = (positions_[i] - center_) / unit_;
    for (int axis = 0; axis < 3; ++axis)
      floats[3 * i + static_cast<size_t>(axis)] = static_cast<float>(local[axis]);
  }
  std::copy(indices_.begin(), indices_.end(), triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

ChunkTree::~ChunkTree() { rtcReleaseScene(scene_); }

double ChunkTree::distance(const Placing& placing, const glm::dvec3& point, double best, double floor) const {
  const glm::dvec3 local = placing.inverse * (point - placing.transform[3]) - center_;
  // Vertices and the point were rounded to floats: four units in the last place of the largest coordinate
  // cover both.
  const double margin = (extent_ + glm::length(local)) * 0x1p-21;
  Search search{&positions_, &indices_, &placing, point - placing.transform[3], best, floor, margin, unit_};
  RTCPointQuery query;
  query.x = static_cast<float>(local.x / unit_);
  query.y = static_cast<float>(local.y / unit_);
  query.z = static_cast<float>(local.z / unit_);
  query.time = 0;
  const double radius = best * placing.stretch + margin;
  query.radius = std::isfinite(radius) ? upward(radius / unit_) : std::numeric_limits<float>::infinity();
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_, &query, &context, visit_triangle, &search);
  return search.best;
}

PackSurfaces::PackSurfaces(const Pack& pack) : pack_(pack), device_(rtcNewDevice(nullptr)) {
  if (!device_)
    fail(pack.name(), "Embree cannot make a device (error {})", static_cast<int>(rtcGetDeviceError(nullptr)));
  const Skeleton& known = pack.skeleton();
  for (const Affine& transform : known.transforms) placings_.emplace_back(transform);
  for (const SceneNode& node : known.scene_nodes) node_boxes_.push_back(known.lattice().box(node.box));
  for (const Placement& placement : known.placements) {
    const ChunkInfo& chunk = known.chunks[placement.chunk];
    const Box local = known.lattices[chunk.lattice].box(chunk.box);
    Box box;
    for (int i = 0; i < 8; ++i)
      box.extend(known.transforms[placement.transform] * glm::dvec4(local.corner(i), 1));
    placement_boxes_.push_back(box);
  }
}

PackSurfaces::~PackSurfaces() {
  trees_.clear();
  rtcReleaseDevice(device_);
}

std::shared_ptr<const ChunkTree> PackSurfaces::tree(uint32_t chunk) const {
  {
    const std::lock_guard lock(mutex_);
    const auto found = trees_.find(chunk);
    if (found != trees_.end()) {
      found->second.last_use = ++uses_;
      return found->second.tree;
    }
  }
  // Built without the lock: Embree's own tasks must not wait for it. Two threads may build the same tree; one
  // is kept.
  const ChunkInfo& info = skeleton().chunks[chunk];
  auto made =
      std::make_shared<const ChunkTree>(device_, pack_.read_chunk(chunk), skeleton().lattices[info.lattice]);
  const std::lock_guard lock(mutex_);
  const auto [entry, added] = trees_.try_emplace(chunk, Entry{made, 0});
  entry->second.last_use = ++uses_;
  if (!added) return entry->second.tree;
  kept_triangles_ += made->triangle_count();
  while (kept_triangles_ > kept_triangles_limit && trees_.size() > 1) {
    const auto oldest = std::min_element(trees_.begin(), trees_.end(), [](const auto& a, const auto& b) {
      return a.second.last_use < b.second.last_use;
    });
    kept_triangles_ -= oldest->second.tree->triangle_count();
    trees_.erase(oldest);
  }
  return made;
}

double PackSurfaces::nearest_placement(const Drawable& drawable, const glm::dvec3& point, double best,
                                       double floor) const {
  for (uint32_t i = 0; i < drawable.placement_count && best > floor; ++i) {
    const uint32_t index = drawable.first_placement + i;
    if (distance_to_box(point, placement_boxes_[index]) >= best) continue;
    const Placement& placement = skeleton().placements[index];
    best = tree(placement.chunk)->distance(placings_[placement.transform], point, best, floor);
  }
  return best;
}

double PackSurfaces::distance_to_drawable(DrawableId drawable, const glm::dvec3& point, double floor) const {
  return nearest_placement(skeleton().drawables[drawable], point, infinite, floor);
}

double PackSurfaces::distance_to_source(SceneNodeId scene_node, const glm::dvec3& point, double floor) const {
  struct Open {
    double distance;
    SceneNodeId node;
  };
  std::vector<Open> open = {{0, scene_node}};
  double best = infinite;
  while (!open.empty() && best > floor) {
    const Open next = open.back();
    open.pop_back();
    if (next.distance >= best) continue;
    const SceneNode& node = skeleton().scene_nodes[next.node];
    if (node.child_count == 0) {
      best = nearest_placement(skeleton().drawables[node.first_drawable], point, best, floor);
      continue;
    }
    const size_t first = open.size();
    for (uint32_t i = 0; i < node.child_count; ++i) {
      const SceneNodeId child = node.first_child + i;
      open.push_back({distance_to_box(point, node_boxes_[child]), child});
    }
    std::sort(open.begin() + static_cast<std::ptrdiff_t>(first),
              open.end(),  // the nearest is looked at first
              [](const Open& a, const Open& b) { return a.distance > b.distance; });
  }
  return best;
}

std::vector<uint32_t> PackSurfaces::source_placements(SceneNodeId scene_node) const {
  std::vector<uint32_t> placements;
  std::vector<SceneNodeId> open = {scene_node};
  while (!open.empty()) {
    const SceneNode& node = skeleton().scene_nodes[open.back()];
    open.pop_back();
    for (uint32_t i = 0; i < node.child_count; ++i) open.push_back(node.first_child + i);
    if (node.child_count > 0) continue;
    const Drawable& finest = skeleton().drawables[node.first_drawable];
    for (uint32_t i = 0; i < finest.placement_count; ++i) placements.push_back(finest.first_placement + i);
  }
  return placements;
}

}  // namespace triptych
