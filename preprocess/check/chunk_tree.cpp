#include "preprocess/check/chunk_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <embree3/rtcore.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace triptych {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

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
  colors_.reserve(triangle_count());
  for (size_t i = 2; i < indices_.size(); i += 3)  // the last corner has the colour of a flat face
    colors_.push_back(chunk.vertices[indices_[i]].color);
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

std::optional<ChunkTree::Hit> ChunkTree::first_hit(const Placing& placing, const glm::dvec3& origin,
                                                   const glm::dvec3& direction, double from) const {
  if (!std::isfinite(placing.stretch)) return std::nullopt;
  const glm::dvec3 start = placing.inverse * (origin - placing.transform[3]) - center_;
  const glm::dvec3 step = placing.inverse * direction;
  // From just before the chunk on: floats are exact enough there, however far away the origin is.
  const double length = glm::length(step), middle = -glm::dot(start, step) / (length * length);
  const double begin = std::max(from, middle - extent_ / length);
  const glm::dvec3 entry = (start + begin * step) / unit_, towards = step / length;
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(entry.x);
  ray.ray.org_y = static_cast<float>(entry.y);
  ray.ray.org_z = static_cast<float>(entry.z);
  ray.ray.dir_x = static_cast<float>(towards.x);
  ray.ray.dir_y = static_cast<float>(towards.y);
  ray.ray.dir_z = static_cast<float>(towards.z);
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  // Once more in double, with the triangle's plane.
  std::array<glm::dvec3, 3> corners;
  for (size_t k = 0; k < 3; ++k)
    corners[k] = positions_[indices_[3 * size_t{ray.hit.primID} + k]] - center_ - start;
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double exact = glm::dot(normal, corners[0]) / glm::dot(normal, step);
  const double about = begin + static_cast<double>(ray.ray.tfar) * unit_ / length;
  const bool agree = std::abs(exact - about) <= extent_ / length * 0x1p-16;
  return Hit{agree ? exact : about, ray.hit.primID};
}

}  // namespace triptych
