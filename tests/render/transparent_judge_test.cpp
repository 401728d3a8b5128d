// An independent judge of transparency: rays that go on through what is transparent, up to the first opaque
// thing, must see the colours of the picture.
#include "lod/cut.hpp"
#include "tests/render/rig.hpp"
#include "tests/support/scenes.hpp"
#include "visibility/shading.hpp"

#include <array>
#include <cmath>
#include <embree3/rtcore.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <optional>

namespace triptych {
namespace {

struct Face {
  glm::vec3 color;  ///< in the light, 0 to 1
  float alpha;
};

struct Hit {
  float depth;
  uint32_t face;
};

/// A cut's triangles in eye space, made without a device: doubles relative to the eye, then floats.
class RayScene {
 public:
  RayScene(const Pack& pack, const FrameView& view)
      : view_(view.view()), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(
        scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    const Skeleton& skeleton = pack.skeleton();
    std::vector<glm::vec3> corners;
    for (const DrawableId id : select_cut(view).drawables) {
      const Drawable& drawable = skeleton.drawables[id];
      for (uint32_t i = 0; i < drawable.placement_count; ++i)
        add(pack, skeleton.placements[drawable.first_placement + i], light_direction(view), corners);
    }
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), corners.size()));
    std::copy(corners.begin(), corners.end(), points);
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), corners.size() / 3));
    for (uint32_t i = 0; i < corners.size(); ++i) indices[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~RayScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  const Face& face(const Hit& hit) const { return faces_[hit.face]; }

  /// What a ray meets up to the first opaque face, the nearest first.
  std::vector<Hit> shoot(double x, double y) const {
    struct Context {
      RTCIntersectContext context;
      std::vector<Hit> hits;
    } all;
    rtcInitIntersectContext(&all.context);
    all.context.filter = [](const RTCFilterFunctionNArguments* arguments) {
      auto& hits = reinterpret_cast<Context*>(arguments->context)->hits;
      const float depth = RTCRayN_tfar(arguments->ray, arguments->N, 0);
      hits.push_back({depth, RTCHitN_primID(arguments->hit, arguments->N, 0)});
      arguments->valid[0] = 0;  // and the ray goes on
    };
    RTCRay ray{};
    ray.dir_x = static_cast<float>(view_.camera.left + x / view_.focal_x());
    ray.dir_y = static_cast<float>(view_.camera.bottom + y / view_.focal_y());
    ray.dir_z = -1;
    ray.tnear = static_cast<float>(view_.camera.near);
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.mask = ~0u;
    rtcOccluded1(scene_, &all.context, &ray);
    std::sort(all.hits.begin(), all.hits.end(), [](const Hit& a, const Hit& b) { return a.depth < b.depth; });
    for (size_t i = 0; i < all.hits.size(); ++i) {
      if (face(all.hits[i]).alpha < 1) continue;
      // What lies in its plane is met, too: whoever asks sees that.
      while (i + 1 < all.hits.size() && are_flush(all.hits[i], all.hits[i + 1])) ++i;
      all.hits.resize(i + 1);
    }
    return all.hits;
  }
  static bool are_flush(const Hit& a, const Hit& b) { return b.depth - a.depth <= 1e-5f * b.depth; }

 private:
  void add(const Pack& pack, const Placement& placement, const glm::vec3& light,
           std::vector<glm::vec3>& corners) {
    const Skeleton& skeleton = pack.skeleton();
    const Lattice& lattice = skeleton.lattices[skeleton.chunks[placement.chunk].lattice];
    const Chunk chunk = pack.read_chunk(placement.chunk);
    for (size_t t = 0; t < chunk.triangle_count(); ++t) {
      std::array<glm::vec3, 3> points;
      for (size_t k = 0; k < 3; ++k) {
        const glm::dvec3 at = skeleton.transforms[placement.transform] *
                              glm::dvec4(lattice.position(chunk.vertices[chunk.indices[3 * t + k]].point), 1);
        points[k] = glm::vec3(view_.rotation() * (at - view_.camera.eye));
        corners.push_back(points[k]);
      }
      const glm::vec3 across = glm::cross(points[1] - points[0], points[2] - points[0]);
      const float length = glm::length(across);
      const glm::vec3 normal = length > 0 ? across / length : glm::vec3(0);
      const auto& base = skeleton.palette[chunk.vertices[chunk.indices[3 * t + 2]].color];
      const float lit =
          ambient_light + diffuse_light * std::abs(glm::dot(normal, light)) + head_light * std::abs(normal.z);
      faces_.push_back({lit * glm::vec3(base[0], base[1], base[2]) / 255.0f, float(base[3]) / 255.0f});
    }
  }

  View view_;
  RTCDevice device_;
  RTCScene scene_;
  std::vector<Face> faces_;
};

/// The colour behind a pixel's centre; nothing where faces lie flush, or an edge is near, so that a device
/// may see another one.
std::optional<glm::vec3> color_at(const RayScene& scene, double x, double y) {
  const std::vector<Hit> hits = scene.shoot(x, y);
  for (size_t i = 1; i < hits.size(); ++i) {
    if (RayScene::are_flush(hits[i - 1], hits[i])) return std::nullopt;
  }
  constexpr double aside = 1.0 / 32;
  for (const auto& [dx, dy] : {std::pair{aside, aside}, {-aside, aside}, {aside, -aside}, {-aside, -aside}}) {
    const std::vector<Hit> beside = scene.shoot(x + dx, y + dy);
    if (!std::ranges::equal(hits, beside, {}, &Hit::face, &Hit::face)) return std::nullopt;
  }
  glm::vec3 color(background_color[0], background_color[1], background_color[2]);
  for (auto hit = hits.rbegin(); hit != hits.rend(); ++hit) {
    const Face& face = scene.face(*hit);
    color += face.alpha * (face.color - color);
  }
  return color;
}

TEST(TransparentJudge, sees_the_colours_of_the_picture_through_glass) {
  const Pack& pack = scenes::pack("glass");
  constexpr int width = 96, height = 72;
  LocalPipeline pipeline(pack, {.width = width, .height = height, .device = test::device()});
  size_t judged = 0, layered = 0, wrong = 0;
  std::vector<View> views = scenes::path(pack.skeleton(), width, height, 2);
  std::erase_if(views, [](const View& view) { return view.camera.orthographic(); });  // rays from one point
  for (uint32_t i = 0; i < views.size(); ++i) {
    const FrameState state{views[i], 0};
    pipeline.draw({i, state});
    const std::vector<uint8_t> colors = pipeline.target().read_colors();
    const RayScene scene(pack, FrameView(pack.skeleton(), state));
    for (int y = 0; y < height; y += 2) {
      for (int x = 0; x < width; x += 2) {
        const auto expected = color_at(scene, x + 0.5, y + 0.5);
        if (!expected) continue;
        ++judged;
        layered += scene.shoot(x + 0.5, y + 0.5).size() > 2;
        const uint8_t* const found = &colors[4 * static_cast<size_t>(y * width + x)];
        for (int k = 0; k < 3; ++k) {
          if (std::abs(255 * (*expected)[k] - found[k]) <= 3) continue;
          ++wrong;
          break;
        }
      }
    }
  }
  RecordProperty("judged", std::to_string(judged));
  RecordProperty("layered", std::to_string(layered));
  RecordProperty("wrong", std::to_string(wrong));
  EXPECT_GT(judged, 10'000u);
  EXPECT_GT(layered, judged / 5) << "through two panes at least";
  EXPECT_LE(wrong, judged / 2000);
}

}  // namespace
}  // namespace triptych
