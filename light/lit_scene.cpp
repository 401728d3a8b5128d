#include "light/lit_scene.hpp"

#include "base/error.hpp"
#include "scene/box.hpp"

#include <algorithm>
#include <embree3/rtcore.h>
#include <limits>

namespace triptych {

struct LitScene::Embree {
  // One thread, so that the tree, and with it the order of equal hits, is the same every time.
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = nullptr;
  ~Embree() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

LitScene::LitScene(const LitModel& model, const std::vector<LitSurface>& surfaces)
    : model_(model), surfaces_(surfaces), embree_(std::make_unique<Embree>()) {
  if (!embree_->device) fail("baked light", "Embree cannot be started");
  Box box;
  for (const glm::dvec3& place : model.places) box.extend(place);
  middle_ = (box.lo + box.hi) * 0.5;
  embree_->scene = rtcNewScene(embree_->device);
  rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), model.places.size()));
  auto* const indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), model.triangles.size()));
  if (!vertices || !indices)
    fail("baked light", "Embree has no memory for {} triangles", model.triangles.size());
  for (size_t i = 0; i < model.places.size(); ++i) {
    for (int k = 0; k < 3; ++k)
      vertices[3 * i + static_cast<size_t>(k)] =
          static_cast<float>((model.places[i][k] - middle_[k]) / model.diagonal);
  }
  for (size_t i = 0; i < model.triangles.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) indices[3 * i + k] = model.triangles[i].corners[k].place;
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(embree_->scene);
  if (rtcGetDeviceError(embree_->device) != RTC_ERROR_NONE)
    fail("baked light", "Embree cannot take the model");
  has_transparent_ = std::ranges::any_of(surfaces, [](const LitSurface& own) { return own.opacity < 1; });
}

LitScene::~LitScene() = default;

namespace {

RTCRay ray_of(const glm::dvec3& origin, const glm::dvec3& direction, double length) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x);
  ray.org_y = static_cast<float>(origin.y);
  ray.org_z = static_cast<float>(origin.z);
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tfar = static_cast<float>(std::min(length, 1e18));
  ray.mask = 0xffffffffu;
  return ray;
}

/// Of floats within the model: by how much a ray goes on behind what it has met.
constexpr float step_behind = 2e-6f;

}  // namespace

void LitScene::trace(const glm::dvec3& origin, const glm::dvec3& direction,
                     const std::function<void(const Hit&)>& take) const {
  const glm::dvec3 from = (origin - middle_) / model_.diagonal;
  double share = 1;
  float begin = 0;
  for (int layer = 0; layer <= most_layers; ++layer) {
    RTCRayHit query{};
    query.ray = ray_of(from, direction, std::numeric_limits<double>::infinity());
    query.ray.tnear = begin;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(embree_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
    const double facing = direction.x * static_cast<double>(query.hit.Ng_x) +
                          direction.y * static_cast<double>(query.hit.Ng_y) +
                          direction.z * static_cast<double>(query.hit.Ng_z);
    const double opacity = surface(query.hit.primID).opacity;
    take({query.hit.primID, static_cast<double>(query.hit.u), static_cast<double>(query.hit.v),
          static_cast<double>(query.ray.tfar) * model_.diagonal, facing > 0, share * opacity});
    share *= 1 - opacity;
    if (share < 1e-3) return;
    begin = query.ray.tfar + step_behind;
  }
}

double LitScene::share_along(const glm::dvec3& origin, const glm::dvec3& direction, double length) const {
  const glm::dvec3 from = (origin - middle_) / model_.diagonal;
  const double reach = length / model_.diagonal;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (!has_transparent_) {
    RTCRay ray = ray_of(from, direction, reach);
    rtcOccluded1(embree_->scene, &context, &ray);
    return ray.tfar < 0 ? 0 : 1;
  }
  double share = 1;
  float begin = 0;
  for (int layer = 0; layer <= most_layers; ++layer) {
    RTCRayHit query{};
    query.ray = ray_of(from, direction, reach);
    query.ray.tnear = begin;
    if (!(begin < query.ray.tfar)) return share;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return share;
    share *= 1 - surface(query.hit.primID).opacity;
    if (share < 1e-3) return 0;
    begin = query.ray.tfar + step_behind;
  }
  return 0;
}

double LitScene::passes(const glm::dvec3& from, const glm::dvec3& to) const {
  const glm::dvec3 way = to - from;
  const double length = glm::length(way);
  return length > 0 ? share_along(from, way / length, length - clearance()) : 1;
}

double LitScene::passes_from_sky(const glm::dvec3& from, const glm::dvec3& direction) const {
  return share_along(from, direction, std::numeric_limits<double>::infinity());
}

}  // namespace triptych
