// An independent judge: whatever a ray through a pixel's centre hits first, in the cut's geometry, is in the
// visible set.
#include "base/inject.hpp"
#include "tests/render/rig.hpp"
#include "tests/support/scenes.hpp"

#include <array>
#include <cmath>
#include <embree3/rtcore.h>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace triptych {
namespace {

/// A cut's triangles in eye space, made without OpenGL: doubles relative to the eye, then floats.
class RayScene {
 public:
  RayScene(const Pack& pack, const View& view, const std::vector<DrawableId>& drawables)
      : view_(view), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    const glm::dmat3 rotation = view.rotation();
    const Skeleton& skeleton = pack.skeleton();
    for (const DrawableId id : drawables) {
      const Drawable& drawable = skeleton.drawables[id];
      for (uint32_t i = 0; i < drawable.placement_count; ++i) {
        const Placement& placement = skeleton.placements[drawable.first_placement + i];
        const Lattice& lattice = skeleton.lattices[skeleton.chunks[placement.chunk].lattice];
        const Affine& transform = skeleton.transforms[placement.transform];
        const Chunk chunk = pack.read_chunk(placement.chunk);
        std::vector<glm::dvec3> points;
        for (const ChunkVertex& vertex : chunk.vertices) {
          points.push_back(rotation *
                           (transform * glm::dvec4(lattice.position(vertex.point), 1) - view.camera.eye));
        }
        std::vector<uint32_t> layers;
        for (size_t k = 0; k < chunk.indices.size(); k += 3)
          layers.push_back(chunk.vertices[chunk.indices[k]].layer);
        add(id, std::move(points), chunk.indices, std::move(layers));
      }
    }
    rtcCommitScene(scene_);
  }
  ~RayScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  struct Hit {
    DrawableId drawable = no_id;
    double depth = std::numeric_limits<double>::infinity();
    /// From the ray to the nearest edge of what it hit.
    double edge_pixels = std::numeric_limits<double>::infinity();
    bool lies_below = false;  ///< something may lie on it in its plane: rays cannot tell which of them shows
  };

  /// pixel: window coordinates; a pixel's centre ends in a half.
  Hit shoot(const glm::dvec2& pixel) const {
    const Camera& camera = view_.camera;
    const glm::dvec3 direction(camera.left + pixel.x / view_.focal_x(),
                               camera.bottom + pixel.y / view_.focal_y(), -1);
    RTCRayHit ray{};
    ray.ray.dir_x = static_cast<float>(direction.x);
    ray.ray.dir_y = static_cast<float>(direction.y);
    ray.ray.dir_z = -1;
    // What lies in the near plane shows.
    ray.ray.tnear = static_cast<float>(camera.near * (1 - 1e-6));
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const Geometry& geometry = geometries_[ray.hit.geomID];
    Hit hit{.drawable = geometry.drawable,
            .depth = static_cast<double>(ray.ray.tfar),
            .lies_below = geometry.layers[ray.hit.primID] > 1};
    for (uint32_t edge = 0; edge < 3; ++edge) {
      const size_t first = size_t{ray.hit.primID} * 3;
      const glm::dvec3 plane = glm::cross(geometry.points[geometry.indices[first + edge]],
                                          geometry.points[geometry.indices[first + (edge + 1) % 3]]);
      const double slope = std::hypot(plane.x / view_.focal_x(), plane.y / view_.focal_y());
      const double distance = slope > 0 ? std::abs(glm::dot(plane, direction)) / slope : 0;
      hit.edge_pixels = std::min(hit.edge_pixels, distance);
    }
    return hit;
  }

  /// Whether the pixel's centre lies so near to an edge, of what it hit or of something before it, that a
  /// rasterizer's snapping may decide otherwise.
  bool on_an_edge(const glm::dvec2& pixel, const Hit& hit) const {
    constexpr double snapping = 1.0 / 128;
    if (hit.edge_pixels < snapping) return true;
    for (const glm::dvec2& step :
         {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}, {0.7, 0.7}, {-0.7, 0.7}, {0.7, -0.7}, {-0.7, -0.7}}) {
      const Hit beside = shoot(pixel + step * snapping);
      if (beside.drawable != hit.drawable && beside.depth < hit.depth) return true;
    }
    return false;
  }

 private:
  struct Geometry {
    DrawableId drawable;
    std::vector<glm::dvec3> points;
    std::vector<uint32_t> indices, layers;
  };

  void add(DrawableId id, std::vector<glm::dvec3> points, const std::vector<uint32_t>& indices,
           std::vector<uint32_t> layers) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), points.size()));
    for (const glm::dvec3& point : points) {
      for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(point[axis]);
    }
    auto* corners = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), indices.size() / 3));
    std::copy(indices.begin(), indices.end(), corners);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, static_cast<unsigned>(geometries_.size()));
    rtcReleaseGeometry(geometry);
    geometries_.push_back({id, std::move(points), indices, std::move(layers)});
  }

  View view_;
  RTCDevice device_;
  RTCScene scene_;
  std::vector<Geometry> geometries_;
};

struct Verdict {
  uint64_t rays = 0, hits = 0;
  uint64_t on_edges = 0;  ///< of drawables that are not in the visible set, within 1/128 pixel of an edge
  uint64_t culled = 0;    ///< of drawables that are not in the visible set although they show
  std::string first;      ///< of the culled ones
};

/// Sends a ray through the centre of every pixel of every frame of the scene's path.
Verdict judge(const std::string& scene_name) {
  const Pack& pack = scenes::pack(scene_name);
  constexpr int width = 192, height = 144;
  LocalPipeline pipeline(pack, {.width = width, .height = height, .device = test::device()});
  std::vector<View> views = scenes::path(pack.skeleton(), width, height, 2);
  std::erase_if(views, [](const View& view) { return view.camera.orthographic(); });  // rays from one point
  Verdict verdict;
  for (size_t i = 0; i < views.size(); ++i) {
    const FrameRecord record = pipeline.draw({static_cast<uint32_t>(i), views[i], scenes::pixel_error(i)});
    const RayScene scene(
        pack, views[i], select_cut(FrameView(pack.skeleton(), {views[i], scenes::pixel_error(i)})).drawables);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        ++verdict.rays;
        const glm::dvec2 pixel(x + 0.5, y + 0.5);
        const RayScene::Hit hit = scene.shoot(pixel);
        if (hit.drawable == no_id) continue;
        ++verdict.hits;
        if (std::binary_search(record.visible.begin(), record.visible.end(), hit.drawable)) continue;
        if (hit.lies_below) continue;
        if (scene.on_an_edge(pixel, hit)) {
          ++verdict.on_edges;
        } else if (verdict.culled++ == 0) {
          verdict.first = fmt::format(
              "frame {}, pixel {}, {}: drawable {} at depth {}, {} pixels from its triangle's edge", i, x, y,
              hit.drawable, hit.depth, hit.edge_pixels);
        }
      }
    }
  }
  return verdict;
}

class EmbreeJudge : public testing::TestWithParam<std::string> {};

TEST_P(EmbreeJudge, finds_everything_that_rays_hit_in_the_visible_set) {
  const Verdict verdict = judge(GetParam());
  fmt::print("{}: {} rays, {} hits; not in the visible set: {} within 1/128 pixel of an edge, {} others\n",
             GetParam(), verdict.rays, verdict.hits, verdict.on_edges, verdict.culled);
  EXPECT_EQ(verdict.culled, 0u) << verdict.first;
  EXPECT_GT(verdict.hits, 1000u);
  EXPECT_LT(verdict.on_edges, verdict.hits / 1000) << "so many cannot be edges";
}

TEST(EmbreeJudgeItself, finds_what_was_withheld) {
  ASSERT_TRUE(inject("withheld-id"));
  EXPECT_GT(judge("room").culled, 1000u);
  clear_injected();
}

INSTANTIATE_TEST_SUITE_P(Scenes, EmbreeJudge, testing::ValuesIn(scenes::names()),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace triptych
