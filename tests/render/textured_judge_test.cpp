// An independent judge of textures, holes and light of surfaces' own: rays that go on through holes and
// glass, up to the first solid place, must see the colours of the picture, wherever texels are larger than
// pixels.
#include "lod/cut.hpp"
#include "scene/transparency.hpp"
#include "tests/render/rig.hpp"
#include "tests/support/scenes.hpp"
#include "visibility/shading.hpp"

#include <array>
#include <cmath>
#include <embree3/rtcore.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <optional>

namespace triptych {
namespace {

double linear(double shown) {
  return shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4);
}
double shown(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

struct Face {
  double lit;
  uint32_t color;
  std::array<glm::dvec2, 3> places;      ///< on the texture
  std::array<glm::dvec3, 3> own_colors;  ///< of vertices, as displayed
  bool has_colors;
};

struct Hit {
  float depth;
  uint32_t face;
  float u, v;
};

/// The finest levels of a pack's textures, read as they are looked at.
class Images {
 public:
  explicit Images(const Pack& pack) : pack_(pack) {}

  /// Linear red, green, blue, and alpha, between four texels.
  glm::dvec4 at(uint32_t texture, const TextureSampler& sampler, const glm::dvec2& place) {
    const Texture& own = pack_.skeleton().textures[texture];
    if (!texels_.contains(texture)) texels_[texture] = pack_.read_texels(texture, 0);
    const glm::dvec2 size(own.width, own.height), at = place * size - 0.5, low = glm::floor(at);
    if (sampler.nearest) return texel(texture, sampler, glm::floor(place * size));
    const glm::dvec2 share = at - low;
    const auto row = [&](double y) {
      return glm::mix(texel(texture, sampler, {low.x, y}), texel(texture, sampler, {low.x + 1, y}), share.x);
    };
    return glm::mix(row(low.y), row(low.y + 1), share.y);
  }

 private:
  static size_t wrapped(double at, uint32_t size, TextureWrap wrap) {
    if (wrap == TextureWrap::clamp) return static_cast<size_t>(std::clamp(at, 0.0, size - 1.0));
    const double turns = std::floor(at / size), within = at - turns * size;
    const bool turned = wrap == TextureWrap::mirrored_repeat && std::fmod(std::abs(turns), 2) == 1;
    return static_cast<size_t>(turned ? size - 1 - within : within);
  }
  glm::dvec4 texel(uint32_t texture, const TextureSampler& sampler, const glm::dvec2& at) {
    const Texture& own = pack_.skeleton().textures[texture];
    const Texel& found = texels_[texture][wrapped(at.y, own.height, sampler.wrap_v) * own.width +
                                          wrapped(at.x, own.width, sampler.wrap_u)];
    return {linear(found[0] / 255.0), linear(found[1] / 255.0), linear(found[2] / 255.0), found[3] / 255.0};
  }

  const Pack& pack_;
  std::map<uint32_t, std::vector<Texel>> texels_;
};

/// A cut's triangles in eye space, made without a device.
class RayScene {
 public:
  RayScene(const Pack& pack, const FrameView& view)
      : pack_(pack),
        view_(view.view()),
        device_(rtcNewDevice("threads=1")),
        scene_(rtcNewScene(device_)),
        images_(pack) {
    rtcSetSceneFlags(
        scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    const Skeleton& skeleton = pack.skeleton();
    for (const DrawableId id : select_cut(view).drawables) {
      const Drawable& drawable = skeleton.drawables[id];
      for (uint32_t i = 0; i < drawable.placement_count; ++i)
        add(skeleton.placements[drawable.first_placement + i], light_direction(view));
    }
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), corners_.size()));
    std::copy(corners_.begin(), corners_.end(), points);
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), corners_.size() / 3));
    for (uint32_t i = 0; i < corners_.size(); ++i) indices[i] = i;
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

  struct Seen {
    glm::dvec3 color{background_color[0], background_color[1], background_color[2]};
    std::vector<uint32_t> faces;  ///< that were seen, but for holes
    std::vector<glm::dvec2> places;
    bool through_hole = false, doubtful = false;
  };
  /// The colour at a place of the picture, in pixels.
  Seen look(double x, double y) {
    struct Layer {
      glm::dvec3 color;
      double alpha;
    };
    std::vector<Layer> layers;
    Seen seen;
    float before = 0;
    for (const Hit& hit : shoot(x, y)) {
      const Face& face = faces_[hit.face];
      const double w = 1.0 - hit.u - hit.v;
      const glm::dvec2 place =
          face.places[0] * w + face.places[1] * double{hit.u} + face.places[2] * double{hit.v};
      const SurfaceMaterial& material = pack_.skeleton().materials[face.color];
      const auto& base = pack_.skeleton().palette[face.color];
      glm::dvec3 color = glm::dvec3(base[0], base[1], base[2]) / 255.0;
      if (face.has_colors)
        color =
            face.own_colors[0] * w + face.own_colors[1] * double{hit.u} + face.own_colors[2] * double{hit.v};
      double alpha = base[3] / 255.0;
      if (material.texture != SurfaceMaterial::no_texture) {
        const glm::dvec4 own = images_.at(material.texture, material.sampler, place);
        for (int k = 0; k < 3; ++k) color[k] = shown(linear(color[k]) * own[k]);
        if (is_transparent(base)) alpha = own.a * material.alpha / 255.0;
        seen.doubtful |= material.cutoff > 0 && std::abs(own.a * 255 - material.cutoff) < 4;
        if (own.a * 255 < material.cutoff) {
          seen.through_hole = true;
          continue;
        }
      }
      color *= face.lit;
      glm::dvec3 glow(0);
      for (int k = 0; k < 3; ++k) glow[k] = linear(material.emission[static_cast<size_t>(k)] / 255.0);
      if (material.emission_texture != SurfaceMaterial::no_texture)
        glow *= glm::dvec3(images_.at(material.emission_texture, material.sampler, place));
      for (int k = 0; k < 3; ++k)
        if (glow[k] > 0) color[k] = shown(std::min(1.0, linear(color[k]) + glow[k]));
      seen.doubtful |= hit.depth - before <= 1e-5f * hit.depth;
      before = hit.depth;
      seen.faces.push_back(hit.face);
      seen.places.push_back(place);
      layers.push_back({color, alpha});
      if (!is_transparent(base)) break;
    }
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer)
      seen.color += layer->alpha * (layer->color - seen.color);
    return seen;
  }
  /// Whether the pixel's neighbour looks less than a texel further along.
  bool is_magnified(const Seen& here, const Seen& beside) const {
    if (here.faces != beside.faces) return false;
    for (size_t i = 0; i < here.faces.size(); ++i) {
      const SurfaceMaterial& material = pack_.skeleton().materials[faces_[here.faces[i]].color];
      for (const uint32_t texture : {material.texture, material.emission_texture}) {
        if (texture == SurfaceMaterial::no_texture) continue;
        const Texture& own = pack_.skeleton().textures[texture];
        if (glm::length((beside.places[i] - here.places[i]) * glm::dvec2(own.width, own.height)) > 0.95)
          return false;
      }
    }
    return true;
  }

 private:
  std::vector<Hit> shoot(double x, double y) const {
    struct Context {
      RTCIntersectContext context;
      std::vector<Hit> hits;
    } all;
    rtcInitIntersectContext(&all.context);
    all.context.filter = [](const RTCFilterFunctionNArguments* arguments) {
      auto& hits = reinterpret_cast<Context*>(arguments->context)->hits;
      const auto n = arguments->N;
      hits.push_back({RTCRayN_tfar(arguments->ray, n, 0), RTCHitN_primID(arguments->hit, n, 0),
                      RTCHitN_u(arguments->hit, n, 0), RTCHitN_v(arguments->hit, n, 0)});
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
    return all.hits;
  }

  void add(const Placement& placement, const glm::vec3& light) {
    const Skeleton& skeleton = pack_.skeleton();
    const Lattice& lattice = skeleton.lattices[skeleton.chunks[placement.chunk].lattice];
    const Chunk chunk = pack_.read_chunk(placement.chunk);
    for (size_t t = 0; t < chunk.triangle_count(); ++t) {
      Face face{};
      face.color = palette_index(chunk, t);
      face.has_colors = !chunk.colors.empty();
      std::array<glm::vec3, 3> points;
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t vertex = chunk.indices[3 * t + k];
        const glm::dvec3 at = skeleton.transforms[placement.transform] *
                              glm::dvec4(lattice.position(chunk.vertices[vertex].point), 1);
        points[k] = glm::vec3(view_.rotation() * (at - view_.camera.eye));
        corners_.push_back(points[k]);
        if (!chunk.coordinates.empty())
          face.places[k] = glm::dvec2(chunk.coordinates[vertex].u, chunk.coordinates[vertex].v) / 65536.0;
        if (face.has_colors)
          face.own_colors[k] =
              glm::dvec3(chunk.colors[vertex][0], chunk.colors[vertex][1], chunk.colors[vertex][2]) / 255.0;
      }
      const glm::vec3 across = glm::cross(points[1] - points[0], points[2] - points[0]);
      const float length = glm::length(across);
      const glm::vec3 normal = length > 0 ? across / length : glm::vec3(0);
      face.lit =
          ambient_light + diffuse_light * std::abs(glm::dot(normal, light)) + head_light * std::abs(normal.z);
      faces_.push_back(face);
    }
  }

  const Pack& pack_;
  View view_;
  RTCDevice device_;
  RTCScene scene_;
  std::vector<glm::vec3> corners_;
  std::vector<Face> faces_;
  Images images_;
};

/// The colour at a pixel's centre; nothing where a device may see another one.
std::optional<RayScene::Seen> color_at(RayScene& scene, double x, double y) {
  RayScene::Seen here = scene.look(x, y);
  if (here.doubtful) return std::nullopt;
  constexpr double aside = 1.0 / 32;
  for (const auto& [dx, dy] : {std::pair{aside, aside}, {-aside, aside}, {aside, -aside}, {-aside, -aside}}) {
    const RayScene::Seen beside = scene.look(x + dx, y + dy);
    if (here.faces != beside.faces || here.through_hole != beside.through_hole) return std::nullopt;
  }
  if (!scene.is_magnified(here, scene.look(x + 1, y)) || !scene.is_magnified(here, scene.look(x, y + 1)))
    return std::nullopt;
  return here;
}

TEST(TexturedJudge, sees_the_colours_of_the_picture_through_holes_and_glass) {
  const Pack& pack = scenes::pack("textured");
  constexpr int width = 96, height = 72;
  LocalPipeline pipeline(pack, {.width = width, .height = height, .device = test::device()});
  size_t judged = 0, through_holes = 0, wrong = 0;
  std::string first;
  std::vector<View> views = scenes::path(pack.skeleton(), width, height, 2);
  std::erase_if(views, [](const View& view) { return view.camera.orthographic(); });  // rays from one point
  for (uint32_t i = 0; i < views.size(); ++i) {
    const FrameState state{views[i], 0};
    pipeline.draw({i, state});
    const std::vector<uint8_t> colors = pipeline.target().read_colors();
    RayScene scene(pack, FrameView(pack.skeleton(), state));
    for (int y = 0; y < height; y += 2) {
      for (int x = 0; x < width; x += 2) {
        const auto expected = color_at(scene, x + 0.5, y + 0.5);
        if (!expected) continue;
        ++judged;
        through_holes += expected->through_hole;
        const uint8_t* const found = &colors[4 * static_cast<size_t>(y * width + x)];
        for (int k = 0; k < 3; ++k) {
          if (std::abs(255 * expected->color[k] - found[k]) <= 5) continue;
          if (wrong++ == 0)
            first = fmt::format("frame {}, pixel {}, {}: {} {} {} instead of {:.0f} {:.0f} {:.0f}", i, x, y,
                                found[0], found[1], found[2], 255 * expected->color.x,
                                255 * expected->color.y, 255 * expected->color.z);
          break;
        }
      }
    }
  }
  fmt::print("{} judged, {} through holes, {} wrong\n", judged, through_holes, wrong);
  EXPECT_GT(judged, 10'000u);
  EXPECT_GT(through_holes, judged / 40);
  EXPECT_LE(wrong, judged / 2000) << first;
}

}  // namespace
}  // namespace triptych
