// An independent judge: whatever a ray through a pixel's centre hits first, in the cut's geometry, is in the
// visible set. Under a section that is what it hits within what is kept.
#include "base/inject.hpp"
#include "tests/render/rig.hpp"
#include "tests/support/scenes.hpp"

#include <array>
#include <cmath>
#include <embree3/rtcore.h>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <map>

namespace triptych {
namespace {

/// A cut's triangles in eye space, made without OpenGL: doubles relative to the eye, then floats.
class RayScene {
 public:
  RayScene(const Pack& pack, const FrameState& state, const std::vector<DrawableId>& drawables)
      : view_(state.view),
        sides_(state.section),
        device_(rtcNewDevice("threads=1")),
        scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    const View& view = view_;
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
        std::vector<uint32_t> indices = chunk.indices;
        const bool mirrored = glm::determinant(glm::dmat3(transform)) < 0;
        for (size_t k = 0; mirrored && k < indices.size(); k += 3) std::swap(indices[k], indices[k + 1]);
        add(id, std::move(points), indices, std::move(layers));
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
    const glm::dvec3 direction = this->direction(pixel);
    const Span kept = span(direction);
    if (!(kept.near < kept.far)) return {};
    // What lies in the near plane shows, and what lies in a side of the section.
    const RTCRayHit ray = cast(direction, kept.near * (1 - 1e-6), kept.far * (1 + 1e-6));
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
    constexpr double snapping = 1.0 / 96;  // two corners, each by up to 1/256 along both axes
    if (hit.edge_pixels < snapping) return true;
    for (const glm::dvec2& step :
         {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}, {0.7, 0.7}, {-0.7, 0.7}, {0.7, -0.7}, {-0.7, -0.7}}) {
      const Hit beside = shoot(pixel + step * snapping);
      if (beside.drawable != hit.drawable && beside.depth < hit.depth) return true;
    }
    return false;
  }

  /// Whether rays beside the pixel's centre hit something where it hits nothing, or the other way round: an
  /// outline, or a section's.
  bool on_an_outline(const glm::dvec2& pixel) const {
    const bool hits = shoot(pixel).drawable != no_id;
    const double step = 1.0 / 16 + view_.focal_length() * 0x1p-19;  // SectionSpace::tolerance()
    for (const double aside : {-step, step}) {
      for (const glm::dvec2& beside : {glm::dvec2(aside, 0), {0, aside}}) {
        if ((shoot(pixel + beside).drawable != no_id) != hits) return true;
      }
    }
    return false;
  }

  /// Whether the ray may come into the section within something solid, whose cut surface then shows: beyond,
  /// it passes more backs than fronts of one chunk.
  bool may_show_a_cap(const glm::dvec2& pixel) const {
    const glm::dvec3 direction = this->direction(pixel);
    double near = span(direction).near;
    if (!(near > view_.camera.near)) return false;
    std::map<unsigned, int> winding;
    for (int i = 0; i < 1000; ++i) {
      RTCRayHit ray = cast(direction, near * (1 + 1e-6), std::numeric_limits<double>::infinity());
      if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) break;
      winding[ray.hit.geomID] +=
          glm::dot(glm::dvec3(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z), direction) > 0 ? 1 : -1;
      near = ray.ray.tfar;
    }
    return std::ranges::any_of(winding, [](const auto& of_chunk) { return of_chunk.second > 0; });
  }

 private:
  struct Span {
    double near, far;
  };
  glm::dvec3 direction(const glm::dvec2& pixel) const {
    const Camera& camera = view_.camera;
    return {camera.left + pixel.x / view_.focal_x(), camera.bottom + pixel.y / view_.focal_y(), -1};
  }
  /// What the section keeps of a ray, from the near plane on.
  Span span(const glm::dvec3& direction) const {
    Span span{view_.camera.near, std::numeric_limits<double>::infinity()};
    for (const SectionPlane& side : sides_.all()) {
      const double from = side.distance(view_.camera.eye),
                   slope = glm::dot(view_.rotation() * side.normal, direction);
      if (slope > 0) span.near = std::max(span.near, -from / slope);
      if (slope < 0) span.far = std::min(span.far, -from / slope);
    }
    return span;
  }
  RTCRayHit cast(const glm::dvec3& direction, double near, double far) const {
    RTCRayHit ray{};
    ray.ray.dir_x = static_cast<float>(direction.x);
    ray.ray.dir_y = static_cast<float>(direction.y);
    ray.ray.dir_z = -1;
    ray.ray.tnear = static_cast<float>(near);
    ray.ray.tfar = static_cast<float>(far);
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &ray);
    return ray;
  }

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
  SectionSides sides_;
  RTCDevice device_;
  RTCScene scene_;
  std::vector<Geometry> geometries_;
};

struct Verdict {
  uint64_t rays = 0, hits = 0;
  uint64_t on_edges = 0;  ///< of drawables that are not in the visible set, within 1/96 pixel of an edge
  uint64_t culled = 0;    ///< of drawables that are not in the visible set although they show
  uint64_t caps = 0;      ///< rays that may show a cut surface, which are not judged
  uint64_t empty = 0;     ///< rays that hit something where nothing is drawn, or the other way round
  std::string first;      ///< of the culled ones
};

/// Planes and boxes that go through the model, another one each frame.
Section random_section(const Skeleton& skeleton, scenes::Random& random) {
  const Box box = skeleton.lattice().box(skeleton.scene_nodes.front().box);
  const auto inside = [&] { return box.lo + (box.hi - box.lo) * random.vector(0.2, 0.8); };
  Section section;
  for (uint32_t planes = random.index(3); planes > 0; --planes) {
    const glm::dvec3 normal = glm::normalize(random.vector(-1, 1) + glm::dvec3(0, 0, 1e-3));
    section.add_plane({normal, glm::dot(normal, inside())}, "test");
  }
  if (section.keeps_all() || random.index(2) == 0) {
    const glm::dvec3 a = inside(), b = inside();
    section.set_box({glm::min(a, b), glm::max(a, b)}, "test");
  }
  return section;
}

/// Sends a ray through the centre of every pixel of every frame of the scene's path.
Verdict judge(const std::string& scene_name, bool sections = false) {
  const Pack& pack = scenes::pack(scene_name);
  constexpr int width = 192, height = 144;
  LocalPipeline pipeline(pack, {.width = width, .height = height, .device = test::device()});
  LocalPipeline items(pack, {.width = width,
                             .height = height,
                             .cull = StrategyKind::frustum,
                             .device = test::device(),
                             .item_buffer = true});
  scenes::Random random(5);
  std::vector<View> views = scenes::path(pack.skeleton(), width, height, 2);
  std::erase_if(views, [](const View& view) { return view.camera.orthographic(); });  // rays from one point
  Verdict verdict;
  for (size_t i = 0; i < views.size(); ++i) {
    FrameState state{views[i], scenes::pixel_error(i)};
    state.effects = Effects::none();  // rays end at the first thing that they meet
    if (sections) state.section = random_section(pack.skeleton(), random);
    const FrameRequest frame{static_cast<uint32_t>(i), state};
    const FrameRecord record = pipeline.draw(frame);
    const RayScene scene(pack, state, select_cut(FrameView(pack.skeleton(), state)).drawables);
    items.draw(frame);
    const std::vector<uint32_t> drawn = items.target().read_items();
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        ++verdict.rays;
        const glm::dvec2 pixel(x + 0.5, y + 0.5);
        const RayScene::Hit hit = scene.shoot(pixel);
        const bool nothing = drawn[static_cast<size_t>(y * width + x)] == 0;
        if (sections && scene.may_show_a_cap(pixel)) {
          ++verdict.caps;
          continue;
        }
        if (sections && nothing != (hit.drawable == no_id) && !scene.on_an_outline(pixel) &&
            verdict.empty++ == 0) {
          verdict.first = fmt::format("frame {}, pixel {}, {}: {} drawn", i, x, y,
                                      nothing ? "nothing" : "what no ray hits is");
        }
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
  fmt::print("{}: {} rays, {} hits; not in the visible set: {} within 1/96 pixel of an edge, {} others\n",
             GetParam(), verdict.rays, verdict.hits, verdict.on_edges, verdict.culled);
  EXPECT_EQ(verdict.culled, 0u) << verdict.first;
  EXPECT_GT(verdict.hits, 1000u);
  EXPECT_LT(verdict.on_edges, verdict.hits / 1000) << "so many cannot be edges";
}

TEST_P(EmbreeJudge, finds_what_a_section_keeps_and_nothing_else) {
  if (GetParam() == "coplanar" || GetParam() == "slivers")
    GTEST_SKIP() << "of faces that coincide rays meet one, and of slivers few";
  const Verdict verdict = judge(GetParam(), true);
  fmt::print(
      "{}: {} rays, {} hits; not in the visible set: {} within 1/96 pixel of an edge, {} others; {} wrong\n",
      GetParam(), verdict.rays, verdict.hits, verdict.on_edges, verdict.culled, verdict.empty);
  EXPECT_EQ(verdict.culled, 0u) << verdict.first;
  // Rays through edges miss a face now and then, and take a solid for an open one.
  EXPECT_LE(verdict.empty, verdict.hits / 4000) << verdict.first;
  EXPECT_GT(verdict.hits, 1000u);
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
