// Projection, frusta, lattices, stretches and ranks against arithmetic of 113 and of 128 bits. RapidCheck
// shrinks what fails; the smallest failing scene becomes a case of the gallery.
#include "lod/cut.hpp"
#include "scene/transforms.hpp"
#include "visibility/screen_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace triptych {
namespace {

__extension__ using Wide = __float128;
__extension__ using WideInteger = __int128;

struct WideVector {
  Wide x, y, z;
};

Wide absolute(Wide value) { return value < 0 ? -value : value; }

/// More than RapidCheck's hundred, unless the environment says otherwise.
const int many_trials = ::setenv("RC_PARAMS", "max_success=4000", 0);

/// From the whole range from the first trial on; shrinks towards lo.
int in_range(int lo, int hi) { return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(lo, hi)); }

/// Thousandths, so that most numbers are no doubles of few bits.
double number(int lo, int hi) { return in_range(lo * 1000, hi * 1000 + 1) / 1000.0; }
glm::dvec3 vector(int lo, int hi) {
  const double x = number(lo, hi), y = number(lo, hi);
  return {x, y, number(lo, hi)};
}

/// A view and a box, at any scale and as far from the origin as doubles bear.
struct Scene {
  Skeleton skeleton;
  View view;
  LatticeBox box;

  Scene() {
    const double scale = std::exp2(in_range(-60, 61));
    const glm::dvec3 origin = glm::floor(vector(-1, 1) * std::exp2(in_range(0, 20)));
    skeleton.lattices = {Lattice{origin * scale, 0x1p-20 * scale}};
    skeleton.scene_nodes = {{.box = {glm::ivec3(-(1 << 26)), glm::ivec3(1 << 26)}}};
    Camera& camera = view.camera;
    camera.eye = (origin + vector(-60, 60)) * scale;
    camera.target = camera.eye + vector(-1, 1) * scale;
    camera.up = vector(-1, 1);
    camera.left = number(-3, 1);
    camera.right = camera.left + std::exp2(number(-12, 2));
    camera.bottom = number(-3, 1);
    camera.top = camera.bottom + std::exp2(number(-12, 2));
    camera.near = std::exp2(number(-14, 3)) * scale;
    if (in_range(0, 4) == 3) {
      camera.projection = Projection::orthographic;
      for (double* side : {&camera.left, &camera.right, &camera.bottom, &camera.top}) *side *= 16 * scale;
    }
    view.width = in_range(1, 3000);
    view.height = in_range(1, 3000);
    const glm::dvec3 lo = vector(-60, 60);
    const glm::dvec3 size = glm::abs(vector(-1, 1)) * std::exp2(in_range(-20, 6));
    box.lo = glm::ivec3(lo * 0x1p20);
    box.hi = box.lo + glm::ivec3(size * 0x1p19);
    try {
      check_camera(camera, "");
    } catch (const std::exception&) {
      RC_DISCARD("a camera that is refused");
    }
  }

  /// Its corners and some points between them.
  glm::ivec3 cell(int i) const {
    return i < 8 ? box.corner(i) : box.lo + glm::ivec3(glm::dvec3(box.hi - box.lo) * (0.13 * (i - 8)));
  }
  /// A point of the box in eye space; the rotation is taken as it is, everything after it is wide.
  WideVector eye_point(int i) const {
    const glm::ivec3 cell = this->cell(i);
    const glm::dmat3 rotation = view.rotation();
    Wide relative[3], turned[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
      relative[axis] = Wide(skeleton.lattice().origin[axis]) + Wide(skeleton.lattice().step) * cell[axis] -
                       Wide(view.camera.eye[axis]);
    }
    for (int row = 0; row < 3; ++row) {
      for (int axis = 0; axis < 3; ++axis) turned[row] += Wide(rotation[axis][row]) * relative[axis];
    }
    return {turned[0], turned[1], turned[2]};
  }
  static constexpr int points = 15;

  /// By how much doubles may be off.
  double slack() const {
    const glm::dvec3 far = glm::abs(skeleton.lattice().origin) + glm::abs(view.camera.eye);
    return 0x1p-48 * (far.x + far.y + far.z);
  }
};

RC_GTEST_PROP(Numbers, a_box_beyond_the_frustum_has_no_point_in_it, ()) {
  const Scene scene;
  if (!FrameView(scene.skeleton, {scene.view}).eye_space.bounds(scene.box).outside) return;
  const Camera& camera = scene.view.camera;
  for (int i = 0; i < Scene::points; ++i) {
    const WideVector p = scene.eye_point(i);
    const Wide depth = -p.z, w = camera.orthographic() ? Wide(1) : depth, slack = scene.slack();
    const bool inside = depth > camera.near + slack && p.x > camera.left * w + slack &&
                        p.x < camera.right * w - slack && p.y > camera.bottom * w + slack &&
                        p.y < camera.top * w - slack;
    RC_ASSERT(!inside);
  }
}

RC_GTEST_PROP(Numbers, the_least_depth_of_a_box_is_at_most_that_of_its_points, ()) {
  const Scene scene;
  const EyeBounds bounds = FrameView(scene.skeleton, {scene.view}).eye_space.bounds(scene.box);
  if (bounds.parallel || bounds.outside) return;
  for (int i = 0; i < Scene::points; ++i)
    RC_ASSERT(-scene.eye_point(i).z >= bounds.min_depth - scene.slack());
}

RC_GTEST_PROP(Numbers, the_rectangle_of_a_box_holds_its_points_with_nearly_half_a_pixel_to_spare, ()) {
  const Scene scene;
  const ScreenBounds found = BoxProjector(FrameView(scene.skeleton, {scene.view})).bounds(scene.box);
  if (found.kind == ScreenBounds::Kind::unbounded) return;
  const Camera& camera = scene.view.camera;
  const ClipSpace clip = FrameView(scene.skeleton, {scene.view}).clip;
  for (int i = 0; i < Scene::points; ++i) {
    const WideVector p = scene.eye_point(i);
    const Wide depth = -p.z, w = camera.orthographic() ? Wide(1) : depth;
    if (depth < clip.near) continue;
    const Wide x = 2 * (p.x / w - camera.left) / (Wide(camera.right) - camera.left) - 1;
    const Wide y = 2 * (p.y / w - camera.bottom) / (Wide(camera.top) - camera.bottom) - 1;
    if (absolute(x) > 1 || absolute(y) > 1) continue;
    RC_ASSERT(found.kind == ScreenBounds::Kind::rectangle);
    const Wide half_x = Wide(0.9) / scene.view.width, half_y = Wide(0.9) / scene.view.height;
    const ScreenRectangle& r = found.rectangle;
    RC_ASSERT(r.left <= -1 || Wide(r.left) <= x - half_x);
    RC_ASSERT(r.right >= 1 || Wide(r.right) >= x + half_x);
    RC_ASSERT(r.bottom <= -1 || Wide(r.bottom) <= y - half_y);
    RC_ASSERT(r.top >= 1 || Wide(r.top) >= y + half_y);
    const Wide exact = clip.orthographic ? 1 - (depth - clip.near) / clip.range : clip.near / depth;
    const float allowed = r.depth(static_cast<float>(x), static_cast<float>(y));
    RC_ASSERT(allowed >= 1 || Wide(allowed) >= exact);
    const DepthBound bound = BoxProjector(FrameView(scene.skeleton, {scene.view})).depth_bound(scene.box);
    RC_ASSERT(bound.nearest >= 1 || Wide(bound.nearest) >= exact * (1 + 0x1p-16));
    for (const DepthPlane& plane : bound.planes) {
      const float beyond = plane.at(static_cast<float>(x), static_cast<float>(y));
      RC_ASSERT(beyond >= 1 || Wide(beyond) >= exact);
    }
  }
}

/// Where the vertex stage puts the point of the lattice in 32-bit floats, in normalised device coordinates;
/// the arithmetic of render/draw_list.cpp and render/shaders.cpp.
std::array<float, 2> drawn_at(const Scene& scene, const ClipSpace& clip, const glm::ivec3& point) {
  const Lattice& lattice = scene.skeleton.lattice();
  const glm::dvec3 cell = glm::clamp(glm::round((clip.reference - lattice.origin) / lattice.step),
                                     double{-Lattice::limit}, double{Lattice::limit});
  const glm::dmat3 rotation = scene.view.rotation();
  const glm::mat3 rows = glm::transpose(glm::mat3(rotation * (lattice.step / clip.unit)));
  const glm::vec3 shift = rotation * ((lattice.origin + lattice.step * cell - clip.reference) / clip.unit);
  const glm::vec3 p(point - glm::ivec3(cell));
  const glm::vec3 eye(glm::dot(rows[0], p) + shift.x, glm::dot(rows[1], p) + shift.y,
                      glm::dot(rows[2], p) + shift.z);
  const Camera& camera = scene.view.camera;
  const auto device = [&](float at, double low, double high) {
    const double scale = camera.orthographic() ? clip.unit : 1;
    const auto stretch = static_cast<float>(2 * scale / (high - low));
    const auto move = static_cast<float>((high + low) / (high - low));
    return camera.orthographic() ? stretch * at - move : (stretch * at + move * eye.z) / -eye.z;
  };
  return {device(eye.x, camera.left, camera.right), device(eye.y, camera.bottom, camera.top)};
}

RC_GTEST_PROP(Numbers, the_rectangle_of_a_box_holds_what_floats_make_of_its_points_in_the_narrowest_views,
              ()) {
  Scene scene;
  Camera& camera = scene.view.camera;
  // Aimed at one of the points.
  const WideVector aim = scene.eye_point(in_range(0, Scene::points));
  const double depth = static_cast<double>(-aim.z), w = camera.orthographic() ? 1 : depth;
  if (!(depth > 0)) RC_DISCARD("a point behind the eye");
  const double narrow = std::exp2(-in_range(0, 18));
  const double width = narrow * (camera.right - camera.left), height = narrow * (camera.top - camera.bottom);
  camera.left = static_cast<double>(aim.x) / w - width * number(0, 1);
  camera.right = camera.left + width;
  camera.bottom = static_cast<double>(aim.y) / w - height * number(0, 1);
  camera.top = camera.bottom + height;
  try {
    check_camera(camera, "");
  } catch (const std::exception&) {
    RC_DISCARD("a camera that is refused");
  }
  const ScreenBounds found = BoxProjector(FrameView(scene.skeleton, {scene.view})).bounds(scene.box);
  if (found.kind == ScreenBounds::Kind::unbounded) return;
  const ClipSpace clip = FrameView(scene.skeleton, {scene.view}).clip;
  const float snap_x = 0.125f / static_cast<float>(scene.view.width);
  const float snap_y = 0.125f / static_cast<float>(scene.view.height);
  for (int i = 0; i < Scene::points; ++i) {
    if (-scene.eye_point(i).z < clip.near) continue;
    const auto [x, y] = drawn_at(scene, clip, scene.cell(i));
    if (!(std::abs(x) <= 1 && std::abs(y) <= 1)) continue;
    RC_ASSERT(found.kind == ScreenBounds::Kind::rectangle);
    const ScreenRectangle& r = found.rectangle;
    RC_ASSERT(r.left <= std::max(-1.0f, x - snap_x) && r.right >= std::min(1.0f, x + snap_x));
    RC_ASSERT(r.bottom <= std::max(-1.0f, y - snap_y) && r.top >= std::min(1.0f, y + snap_y));
  }
}

RC_GTEST_PROP(Numbers, the_nearest_lattice_point_is_within_the_rounding_that_is_counted, ()) {
  const double scale = std::exp2(in_range(-200, 201));
  Box box;
  const glm::dvec3 place = vector(-1, 1) * std::exp2(in_range(0, 30));
  for (int i = 0; i < 3; ++i) box.extend((place + vector(-10, 10)) * scale);
  const Lattice lattice = make_lattice(box, 26);
  const LatticeBox around = lattice.enclosing(box);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 p = box.corner(i);
    const glm::ivec3 cell = lattice.nearest(p);
    Wide squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const Wide off = Wide(lattice.origin[axis]) + Wide(lattice.step) * cell[axis] - Wide(p[axis]);
      squared += off / lattice.step * (off / lattice.step);
      RC_ASSERT(Wide(lattice.position(cell)[axis]) ==
                Wide(lattice.origin[axis]) + Wide(lattice.step) * cell[axis]);
      RC_ASSERT(Wide(lattice.position(around.lo)[axis]) <= Wide(box.lo[axis]));
      RC_ASSERT(Wide(lattice.position(around.hi)[axis]) >= Wide(box.hi[axis]));
      RC_ASSERT(std::abs(cell[axis]) <= Lattice::limit / 2);
    }
    RC_ASSERT(squared <= Wide(0.75) * (1 + 0x1p-40));
  }
}

RC_GTEST_PROP(Numbers, no_vector_is_stretched_by_more_than_the_largest_stretch, ()) {
  Affine transform(1);
  const int exponent = in_range(-40, 41);
  for (int column = 0; column < 3; ++column) transform[column] = vector(-3, 3) * std::exp2(exponent);
  const Wide stretch = largest_stretch(transform);
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 v = vector(-5, 5);
    Wide before = 0, after = 0;
    for (int row = 0; row < 3; ++row) {
      Wide sum = 0;
      for (int column = 0; column < 3; ++column) sum += Wide(transform[column][row]) * v[column];
      after += sum * sum;
      before += Wide(v[row]) * v[row];
    }
    RC_ASSERT(after <= stretch * stretch * before);
  }
}

RC_GTEST_PROP(Numbers, squared_distances_are_exact_and_no_child_is_nearer_than_its_parent, ()) {
  const auto coordinate = [] { return in_range(-Lattice::limit, Lattice::limit + 1); };
  LatticeBox outer, inner;
  glm::ivec3 cell;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<int, 4> sides = {coordinate(), coordinate(), coordinate(), coordinate()};
    std::sort(sides.begin(), sides.end());
    outer.lo[axis] = sides[0], inner.lo[axis] = sides[1], inner.hi[axis] = sides[2],
    outer.hi[axis] = sides[3];
    cell[axis] = coordinate();
  }
  WideInteger exact = 0;
  for (int axis = 0; axis < 3; ++axis) {
    WideInteger off = 0;
    if (cell[axis] < inner.lo[axis]) off = WideInteger{inner.lo[axis]} - cell[axis];
    if (cell[axis] > inner.hi[axis]) off = WideInteger{cell[axis]} - inner.hi[axis];
    exact += off * off;
  }
  RC_ASSERT(WideInteger{squared_distance(cell, inner)} == exact);
  RC_ASSERT(squared_distance(cell, outer) <= squared_distance(cell, inner));
}

}  // namespace
}  // namespace triptych
