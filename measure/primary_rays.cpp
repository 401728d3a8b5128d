#include "measure/primary_rays.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/threads.hpp"
#include "scene/sample_places.hpp"
#include "visibility/shading.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <embree3/rtcore.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <span>
#include <sys/types.h>
#include <utility>

namespace triptych {

namespace {

/// Where rays start and where they go, in the model's floats: at pixel (x, y) of window coordinates, each is
/// `at_zero` + x · `per_x` + y · `per_y`.
struct RayField {
  struct Linear {
    glm::vec3 at_zero{0}, per_x{0}, per_y{0};
  };
  Linear origin, direction;
  float near = 0;
  glm::vec3 light, to_eye;  ///< unit vectors in model space
  /// A side of a section: what is kept of the model has dot(normal, p) >= offset.
  struct Side {
    glm::vec3 normal{0};
    float offset = 0;
  };
  std::vector<Side> sides = {};
};

/// From where to where a ray lies in what all sides keep; empty where near > far. Faces in a side are kept.
struct RayStretch {
  float near, far;
};
RayStretch kept_stretch(const RayField& field, const glm::vec3& origin, const glm::vec3& direction) {
  constexpr float in_a_side = 1e-6f;  // of the distance
  RayStretch kept{field.near, std::numeric_limits<float>::infinity()};
  for (const RayField::Side& side : field.sides) {
    const float at = glm::dot(side.normal, origin) - side.offset, slope = glm::dot(side.normal, direction);
    if (slope > 0) {
      kept.near = std::max(kept.near, -at / slope * (1 - in_a_side));
    } else if (slope < 0) {
      kept.far = std::min(kept.far, -at / slope * (1 + in_a_side));
    } else if (at < 0) {
      kept.far = -1;
    }
  }
  return kept;
}

RayField ray_field(const FlatModel& model, const View& view, const Section& section) {
  const Camera& camera = view.camera;
  const glm::dmat3 axes = glm::transpose(view.rotation());  // eye to model
  const glm::dvec3 eye = (camera.eye - model.origin) / model.unit;
  const glm::dvec3 per_x = axes[0] / view.focal_x(), per_y = axes[1] / view.focal_y();
  const glm::dvec3 corner = axes[0] * camera.left + axes[1] * camera.bottom;
  RayField field;
  field.near = static_cast<float>(camera.near / model.unit);
  field.light = light_in_model();
  field.to_eye = axes[2];
  if (camera.orthographic()) {
    field.origin = {eye + corner / model.unit, per_x / model.unit, per_y / model.unit};
    field.direction.at_zero = -axes[2];
  } else {
    field.origin.at_zero = eye;
    field.direction = {corner - axes[2], per_x, per_y};
  }
  for (const SectionPlane& side : SectionSides(section).all()) {
    field.sides.push_back(
        {glm::vec3(side.normal), static_cast<float>(-side.distance(model.origin) / model.unit)});
  }
  return field;
}

/// Packets of Embree by their width: pixels side by side, and its call.
template <int width>
struct Packet;
template <>
struct Packet<4> {
  using RayHit = RTCRayHit4;
  static constexpr int columns = 2;
  static constexpr auto intersect = rtcIntersect4;
};
template <>
struct Packet<8> {
  using RayHit = RTCRayHit8;
  static constexpr int columns = 4;
  static constexpr auto intersect = rtcIntersect8;
};
template <>
struct Packet<16> {
  using RayHit = RTCRayHit16;
  static constexpr int columns = 4;
  static constexpr auto intersect = rtcIntersect16;
};

/// What all packets of a frame share.
struct Frame {
  const FlatModel& model;
  RTCScene scene;
  RayField field;
  int width, height;
  std::span<const SamplePlace> places;
  uint8_t* colors;
};

void shade(const Frame& frame, const glm::vec3& normal, uint32_t triangle, uint8_t* color) {
  const float length_squared = glm::dot(normal, normal);
  const float scale = length_squared > 0 ? 1 / std::sqrt(length_squared) : 0;
  const float light = ambient_light + scale * (diffuse_light * std::abs(glm::dot(normal, frame.field.light)) +
                                               head_light * std::abs(glm::dot(normal, frame.field.to_eye)));
  const uint32_t last_corner = frame.model.indices[size_t{triangle} * 3 + 2];  // OpenGL's provoking vertex
  const std::array<uint8_t, 4>& base = frame.model.vertices[last_corner].color;
  for (size_t channel = 0; channel < 3; ++channel)
    color[channel] = static_cast<uint8_t>(static_cast<float>(base[channel]) * light + 0.5f);
  color[3] = 255;
}

/// Whether Embree takes it: beyond its limit it throws through its own C functions.
bool within_embree(const glm::vec3& v) {
  constexpr float largest = 1.844e18f;
  return std::abs(v.x) < largest && std::abs(v.y) < largest && std::abs(v.z) < largest;
}

/// Adds what one sample of each of the pixels shows to their sums of red, green and blue.
template <int width>
void trace_sample(const Frame& frame, int left, int bottom, const glm::vec2& place,
                  std::array<std::array<uint32_t, 3>, width>& sums) {
  constexpr int columns = Packet<width>::columns;
  alignas(64) int valid[width];
  alignas(64) typename Packet<width>::RayHit packet;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (int i = 0; i < width; ++i) {
    const int x = left + i % columns, y = bottom + i / columns;
    const float at_x = static_cast<float>(x) + place.x, at_y = static_cast<float>(y) + place.y;
    const auto at = [&](const RayField::Linear& linear) {
      return linear.at_zero + at_x * linear.per_x + at_y * linear.per_y;
    };
    glm::vec3 origin = at(frame.field.origin), direction = at(frame.field.direction);
    auto [near, far] = kept_stretch(frame.field, origin, direction);
    const bool in_picture = x < frame.width && y < frame.height;
    const bool castable =
        within_embree(origin) && within_embree(direction) && within_embree({near, 0, 0}) && near <= far;
    valid[i] = in_picture && castable ? -1 : 0;
    // Lanes that are not cast must hold rays all the same; from that far away nothing is seen.
    if (!castable) origin = {0, 0, 0}, direction = {0, 0, 1}, near = 0, far = 1;
    packet.ray.org_x[i] = origin.x;
    packet.ray.org_y[i] = origin.y;
    packet.ray.org_z[i] = origin.z;
    packet.ray.dir_x[i] = direction.x;
    packet.ray.dir_y[i] = direction.y;
    packet.ray.dir_z[i] = direction.z;
    packet.ray.tnear[i] = near;
    packet.ray.tfar[i] = far;
    packet.ray.time[i] = 0;
    packet.ray.mask[i] = ~0u;
    packet.ray.id[i] = 0;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  Packet<width>::intersect(valid, frame.scene, &context, &packet);
  for (int i = 0; i < width; ++i) {
    std::array<uint8_t, 4> color = background_bytes;
    if (packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
      shade(frame, {packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]}, packet.hit.primID[i],
            color.data());
    for (size_t channel = 0; channel < 3; ++channel) sums[static_cast<size_t>(i)][channel] += color[channel];
  }
}

template <int width>
void trace_packet(const Frame& frame, int left, int bottom) {
  constexpr int columns = Packet<width>::columns;
  std::array<std::array<uint32_t, 3>, width> sums{};
  for (const SamplePlace& place : frame.places)
    trace_sample<width>(frame, left, bottom, glm::vec2(0.5 + place.pixels()), sums);
  const auto samples = static_cast<uint32_t>(frame.places.size());
  for (int i = 0; i < width; ++i) {
    const int x = left + i % columns, y = bottom + i / columns;
    if (x >= frame.width || y >= frame.height) continue;
    uint8_t* const color = frame.colors + 4 * (static_cast<size_t>(y) * static_cast<size_t>(frame.width) +
                                               static_cast<size_t>(x));
    for (size_t channel = 0; channel < 3; ++channel)
      color[channel] = static_cast<uint8_t>((sums[static_cast<size_t>(i)][channel] + samples / 2) / samples);
    color[3] = 255;
  }
}

/// Tile by tile: rays of one tile meet the same part of the tree.
template <int width>
void trace(const Frame& frame) {
  constexpr int tile = 16, columns = Packet<width>::columns, rows = width / columns;
  const int across = (frame.width + tile - 1) / tile, up = (frame.height + tile - 1) / tile;
  parallel_for(static_cast<size_t>(across) * static_cast<size_t>(up), [&](size_t index) {
    const int left = static_cast<int>(index) % across * tile,
              bottom = static_cast<int>(index) / across * tile;
    for (int y = bottom; y < std::min(bottom + tile, frame.height); y += rows) {
      for (int x = left; x < std::min(left + tile, frame.width); x += columns)
        trace_packet<width>(frame, x, y);
    }
  });
}

}  // namespace

struct PrimaryRays::Tree {
  std::atomic<int64_t> bytes = 0;
  int64_t max_bytes = 0;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  double build_seconds = 0;

  ~Tree() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  /// Embree calls it for all that it takes and gives back; an answer of false ends the build.
  static bool count(void* tree, ssize_t bytes, bool) {
    auto& own = *static_cast<Tree*>(tree);
    return (own.bytes += bytes) <= own.max_bytes || bytes <= 0;
  }
  bool build(const FlatModel& model);
};

bool PrimaryRays::Tree::build(const FlatModel& model) {
  device = rtcNewDevice("");
  if (!device) fail("Embree", "there is no device: error {}", static_cast<int>(rtcGetDeviceError(nullptr)));
  rtcSetDeviceMemoryMonitorFunction(device, count, this);
  const Stopwatch stopwatch;
  scene = rtcNewScene(device);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, model.vertices.data(), 0,
                             sizeof(FlatVertex), model.vertices.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, model.indices.data(), 0,
                             3 * sizeof(uint32_t), model.triangle_count());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  build_seconds = stopwatch.seconds();
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) return false;
  if (error != RTC_ERROR_NONE) fail("Embree", "the tree cannot be built: error {}", static_cast<int>(error));
  return true;
}

std::unique_ptr<PrimaryRays> PrimaryRays::build(const FlatModel& model, uint64_t max_bytes) {
  auto tree = std::make_unique<Tree>();
  tree->max_bytes = static_cast<int64_t>(std::min<uint64_t>(max_bytes, std::numeric_limits<int64_t>::max()));
  if (!tree->build(model)) return nullptr;
  return std::unique_ptr<PrimaryRays>(new PrimaryRays(model, std::move(tree)));
}

PrimaryRays::PrimaryRays(const FlatModel& model, std::unique_ptr<Tree> tree)
    : model_(model), tree_(std::move(tree)) {}

PrimaryRays::~PrimaryRays() = default;

void PrimaryRays::draw(const View& view, const Section& section, uint32_t samples) {
  colors_.resize(4 * static_cast<size_t>(view.width) * static_cast<size_t>(view.height));
  const Frame frame{model_,        tree_->scene, ray_field(model_, view, section),
                    view.width,    view.height,  sample_places(samples),
                    colors_.data()};
  const auto is_native = [&](RTCDeviceProperty property) {
    return rtcGetDeviceProperty(tree_->device, property) != 0;
  };
  if (is_native(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) {
    trace<16>(frame);
  } else if (is_native(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) {
    trace<8>(frame);
  } else {
    trace<4>(frame);
  }
}

double PrimaryRays::build_seconds() const { return tree_->build_seconds; }
uint64_t PrimaryRays::memory_bytes() const { return static_cast<uint64_t>(tree_->bytes.load()); }

}  // namespace triptych
