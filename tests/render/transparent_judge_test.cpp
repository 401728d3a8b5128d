// An independent judge of transparency and of shading normals: rays that go on through what is transparent,
// up to the first opaque thing, must see the colours of the picture.
#include "lod/cut.hpp"
#include "tests/render/rig.hpp"
#include "tests/support/scenes.hpp"
#include "visibility/shading.hpp"

#include <array>
#include <cmath>
#include <embree3/rtcore.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>
#include <optional>

namespace triptych {
namespace {

struct Face {
  glm::vec3 base;  ///< 0 to 1
  float alpha;
  std::array<glm::vec3, 3> normals;  ///< of its corners; all its own where they have none
  glm::vec3 facet;                   ///< its own
};

struct Hit {
  float depth;
  uint32_t face;
  float u, v;  ///< weights of its second and third corner
};

/// A cut's triangles in eye space, made without a device: doubles relative to the eye, then floats.
class RayScene {
 public:
  RayScene(const Pack& pack, const FrameView& view)
      : view_(view.view()),
        light_(light_direction(view)),
        device_(rtcNewDevice("threads=1")),
        scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(
        scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    const Skeleton& skeleton = pack.skeleton();
    std::vector<glm::vec3> corners;
    for (const DrawableId id : select_cut(view).drawables) {
      const Drawable& drawable = skeleton.drawables[id];
      for (uint32_t i = 0; i < drawable.placement_count; ++i)
        add(pack, skeleton.placements[drawable.first_placement + i], corners);
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
  glm::vec3 color(const Hit& hit) const {
    const auto& [a, b, c] = face(hit).normals;
    const glm::vec3 sum = (1 - hit.u - hit.v) * a + hit.u * b + hit.v * c;
    return face(hit).base * lit(sum);
  }
  /// By how much its light differs from that on a flat face.
  float bend(const Hit& hit) const { return glm::length(color(hit) - face(hit).base * lit(face(hit).facet)); }

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
      hits.push_back({depth, RTCHitN_primID(arguments->hit, arguments->N, 0),
                      RTCHitN_u(arguments->hit, arguments->N, 0),
                      RTCHitN_v(arguments->hit, arguments->N, 0)});
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
  float lit(const glm::vec3& direction) const {
    const float length = glm::length(direction);
    const glm::vec3 normal = length > 0 ? direction / length : glm::vec3(0);
    return ambient_light + diffuse_light * std::abs(glm::dot(normal, light_)) +
           head_light * std::abs(normal.z);
  }

  void add(const Pack& pack, const Placement& placement, std::vector<glm::vec3>& corners) {
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
      std::array<glm::vec3, 3> normals = {across, across, across};
      const glm::dmat3 linear(skeleton.transforms[placement.transform]);
      const glm::dmat3 with_surface = glm::transpose(glm::inverse(linear));
      for (size_t k = 0; k < 3 && !chunk.normals.empty(); ++k) {
        const VertexNormal& own = chunk.normals[chunk.indices[3 * t + k]];
        if (has_normal(own))
          normals[k] = glm::vec3(glm::normalize(view_.rotation() * (with_surface * direction_of(own))));
      }
      const auto& base = skeleton.palette[chunk.vertices[chunk.indices[3 * t + 2]].color];
      faces_.push_back(
          {glm::vec3(base[0], base[1], base[2]) / 255.0f, float(base[3]) / 255.0f, normals, across});
    }
  }

  View view_;
  glm::vec3 light_;
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
    color += scene.face(*hit).alpha * (scene.color(*hit) - color);
  }
  return color;
}

struct Verdict {
  size_t judged = 0, layered = 0, bent = 0, wrong = 0;
};

/// Of pictures of the scene from many sides, at this pixel error.
Verdict judge(const std::string& name, double pixel_error) {
  const Pack& pack = scenes::pack(name);
  constexpr int width = 96, height = 72;
  LocalPipeline pipeline(pack, {.width = width, .height = height, .device = test::device()});
  Verdict verdict;
  std::vector<View> views = scenes::path(pack.skeleton(), width, height, 2);
  std::erase_if(views, [](const View& view) { return view.camera.orthographic(); });  // rays from one point
  for (uint32_t i = 0; i < views.size(); ++i) {
    const FrameState state{views[i], pixel_error};
    pipeline.draw({i, state});
    const std::vector<uint8_t> colors = pipeline.target().read_colors();
    const RayScene scene(pack, FrameView(pack.skeleton(), state));
    for (int y = 0; y < height; y += 2) {
      for (int x = 0; x < width; x += 2) {
        const auto expected = color_at(scene, x + 0.5, y + 0.5);
        if (!expected) continue;
        ++verdict.judged;
        const std::vector<Hit> hits = scene.shoot(x + 0.5, y + 0.5);
        verdict.layered += hits.size() > 2;
        verdict.bent += !hits.empty() && 255 * scene.bend(hits.front()) > 8;
        const uint8_t* const found = &colors[4 * static_cast<size_t>(y * width + x)];
        for (int k = 0; k < 3; ++k) {
          if (std::abs(255 * (*expected)[k] - found[k]) <= 3) continue;
          ++verdict.wrong;
          break;
        }
      }
    }
  }
  testing::Test::RecordProperty("judged", std::to_string(verdict.judged));
  testing::Test::RecordProperty("layered", std::to_string(verdict.layered));
  testing::Test::RecordProperty("bent", std::to_string(verdict.bent));
  testing::Test::RecordProperty("wrong", std::to_string(verdict.wrong));
  return verdict;
}

TEST(TransparentJudge, sees_the_colours_of_the_picture_through_glass) {
  const Verdict verdict = judge("glass", 0);
  EXPECT_GT(verdict.judged, 10'000u);
  EXPECT_GT(verdict.layered, verdict.judged / 5) << "through two panes at least";
  EXPECT_LE(verdict.wrong, verdict.judged / 2000);
}

TEST(TransparentJudge, sees_what_normals_of_corners_make_round) {
  for (const double pixel_error : {0.0, 4.0}) {
    const Verdict verdict = judge("smooth", pixel_error);
    EXPECT_GT(verdict.judged, 5'000u);
    EXPECT_GT(verdict.bent, verdict.judged / 20) << "where a flat face would be seen to be one";
    EXPECT_LE(verdict.wrong, verdict.judged / 1000) << "at " << pixel_error;
  }
}

}  // namespace
}  // namespace triptych
