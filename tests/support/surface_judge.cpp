#include "tests/support/surface_judge.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace triptych::judge {

namespace {

double to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0;
  return glm::distance(p, a + along * t);
}

/// To the plane where the foot lies inside all three sides; else to the nearest side.
double to_triangle(const glm::dvec3& p, const Corners& t) {
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 3; ++i) nearest = std::min(nearest, to_segment(p, t[i], t[(i + 1) % 3]));
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double length = glm::length(normal);
  if (!(length > 0)) return nearest;
  for (size_t i = 0; i < 3; ++i) {
    if (glm::dot(glm::cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) < 0) return nearest;
  }
  return std::min(nearest, std::abs(glm::dot(p - t[0], normal)) / length);
}

struct Search {
  const std::vector<Corners>* triangles;
  glm::dvec3 point;
  double nearest;
  double unit, margin;
};

bool keep_nearest(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<Search*>(arguments->userPtr);
  const double distance = to_triangle(search.point, (*search.triangles)[arguments->primID]);
  if (!(distance < search.nearest)) return false;
  search.nearest = distance;
  arguments->query->radius = static_cast<float>((distance + search.margin) / search.unit * (1 + 1e-6));
  return true;
}

bool visit_all(RTCPointQueryFunctionArguments* arguments) {
  (*static_cast<const std::function<void(size_t)>*>(arguments->userPtr))(arguments->primID);
  return false;
}

}  // namespace

NearestTriangles::NearestTriangles(std::vector<Corners> triangles)
    : triangles_(std::move(triangles)), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
  glm::dvec3 low = triangles_.at(0)[0], high = low;
  for (const Corners& corners : triangles_) {
    for (const glm::dvec3& corner : corners) low = glm::min(low, corner), high = glm::max(high, corner);
  }
  center_ = (low + high) * 0.5;
  const glm::dvec3 size = high - low;
  unit_ = std::max({size.x, size.y, size.z, 1e-300});
  margin_ = unit_ * 0x1p-20;
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(triangles_.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* arguments) {
        const auto& self = *static_cast<const NearestTriangles*>(arguments->geometryUserPtr);
        const Corners& t = self.triangles_[arguments->primID];
        const glm::vec3 lo((glm::min(glm::min(t[0], t[1]), t[2]) - self.center_ - self.margin_) / self.unit_);
        const glm::vec3 hi((glm::max(glm::max(t[0], t[1]), t[2]) - self.center_ + self.margin_) / self.unit_);
        RTCBounds& box = *arguments->bounds_o;
        box.lower_x = lo.x, box.lower_y = lo.y, box.lower_z = lo.z;
        box.upper_x = hi.x, box.upper_y = hi.y, box.upper_z = hi.z;
      },
      nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

NearestTriangles::~NearestTriangles() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void NearestTriangles::query(const glm::dvec3& point, double radius, RTCPointQueryFunction function,
                             void* data) const {
  const glm::vec3 place((point - center_) / unit_);
  const double far =
      std::max({1.0, std::abs(double(place.x)), std::abs(double(place.y)), std::abs(double(place.z))});
  RTCPointQuery query{};
  query.x = place.x, query.y = place.y, query.z = place.z;
  query.radius = static_cast<float>((radius / unit_ + far * 0x1p-20) * (1 + 1e-6));
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_, &query, &context, function, data);
}

double NearestTriangles::distance(const glm::dvec3& point, double limit) const {
  // A first answer keeps the search within bounds of which floats are sure.
  Search search{&triangles_, point, std::min(limit, to_triangle(point, triangles_[0])), unit_,
                margin_ + glm::distance(point, center_) * 0x1p-20};
  query(point, search.nearest, keep_nearest, &search);
  return search.nearest;
}

void NearestTriangles::near(const glm::dvec3& point, double radius,
                            const std::function<void(size_t)>& visit) const {
  query(point, radius, visit_all, const_cast<std::function<void(size_t)>*>(&visit));
}

double furthest(std::span<const Corners> from, const NearestTriangles& to, int steps) {
  double largest = 0;
  for (const Corners& t : from) {
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const double u = double(i) / steps, v = double(j) / steps;
        largest = std::max(largest, to.distance(t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v));
      }
    }
  }
  return largest;
}

}  // namespace triptych::judge
