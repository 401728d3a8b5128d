// What is measured, against geometry whose every size is known.
#include "view/measuring.hpp"

#include "lod/cut.hpp"
#include "lod/frame_view.hpp"
#include "preprocess/build.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/scenes.hpp"
#include "view/measurement.hpp"
#include "view/snap.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

namespace triptych {
namespace {

View view_of(const glm::dvec3& eye, const glm::dvec3& target) {
  View view{.camera = {.eye = eye, .target = target}, .width = 400, .height = 300};
  set_field_of_view(view.camera, 50, 4.0 / 3);
  view.camera.near = 0.01;
  return view;
}

/// Triangles as feature_edges() takes them.
std::vector<NearFacet> facets_of(const Mesh& mesh) {
  std::vector<NearFacet> facets;
  for (const Triangle& triangle : mesh.triangles) {
    NearFacet& facet = facets.emplace_back();
    for (size_t k = 0; k < 3; ++k) facet.corners[k] = mesh.positions[triangle.vertices[k]];
  }
  return facets;
}

TEST(FeatureEdges, of_many_triangles_take_no_more_than_their_memory) {
  // Neighbours in a grid have numbers one after the other; of a fan all edges have one end in common.
  const uint32_t cells = 150;
  const size_t inner = 3 * cells * cells - 2 * cells, rim = 4 * cells;
  EXPECT_EQ(feature_edges(facets_of(awkward::grid(cells, 1, 0.1)), 1e-9, 0).size(), inner + rim);
  Mesh fan{"fan", {{0, 1, 0}}, {}};
  const uint32_t blades = 20'000;
  for (uint32_t i = 0; i < blades; ++i) {
    const double angle = 2 * glm::pi<double>() * i / blades;
    fan.positions.push_back({std::cos(angle), 0, std::sin(angle)});
    fan.triangles.push_back({{0, 1 + i, 1 + (i + 1) % blades}, 0});
  }
  EXPECT_EQ(feature_edges(facets_of(fan), 1e-9, 0).size(), 2 * blades);
}

/// A box of 2 x 3 x 4 from its origin on, placed as told, alone in a pack.
class PlacedBox : public testing::Test {
 protected:
  void place(const Affine& transform, const Affine& other = Affine(1)) {
    Model model;
    model.materials.emplace_back();
    model.meshes.push_back(awkward::box({0, 0, 0}, {2, 3, 4}));
    model.instances.emplace_back(0, transform);
    if (other != Affine(1)) model.instances.emplace_back(0, other);
    const auto file = std::filesystem::path(testing::TempDir()) /
                      ("triptych_measured_" + std::to_string(::getpid()) + ".tpk");
    build_pack(std::move(model), {}, file);
    pack.emplace(file);
    std::filesystem::remove(file);
    chunks.emplace(*pack);
    for (int i = 0; i < 8; ++i)
      corners[static_cast<size_t>(i)] = transform * glm::dvec4(Box{{0, 0, 0}, {2, 3, 4}}.corner(i), 1);
  }

  /// What is meant so many pixels beside a point.
  std::optional<Snap> snap_beside(const View& view, const glm::dvec3& point, const glm::dvec2& beside,
                                  const Section& section = {}) {
    const PictureSpace space(view);
    const FrameState frame{view, 64, 1, false, section};  // coarse
    const Cut cut = select_cut(FrameView(pack->skeleton(), frame));
    return snap(NearCursor(pack->skeleton(), *chunks, frame, cut.drawables,
                           space.pixel(space.from_eye(point)) + beside, snap_pixels));
  }

  std::optional<Pack> pack;
  std::optional<ChunkShelf> chunks;
  std::array<glm::dvec3, 8> corners;
};

void expect_near(const glm::dvec3& found, const glm::dvec3& wanted, double by) {
  EXPECT_LT(glm::distance(found, wanted), by) << found.x << " " << found.y << " " << found.z << " instead of "
                                              << wanted.x << " " << wanted.y << " " << wanted.z;
}

std::vector<Affine> placements() {
  glm::dmat4 turned = glm::translate(glm::dmat4(1), {5'400'000, 120, -3'100'000});
  turned = glm::rotate(turned, 0.7, {1, 2, 3});
  const glm::dmat4 far = glm::translate(glm::dmat4(1), {5'400'000, 120, -3'100'000});
  const glm::dmat4 mirrored = glm::scale(turned, {-1, 1, 1});
  return {Affine(1), Affine(far), Affine(turned), Affine(mirrored)};
}

TEST_F(PlacedBox, has_corners_wherever_it_stands_that_are_as_far_apart_as_its_sides_are_long) {
  for (const Affine& transform : placements()) {
    // Placed twice, so that its mesh stays on a lattice of its own.
    Affine other = transform;
    other[3] += glm::dvec3(30, 0, 0);
    place(transform, other);
    const glm::dvec3 middle = transform * glm::dvec4(1, 1.5, 2, 1);
    const View view = view_of(transform * glm::dvec4(9, 7, 12, 1), middle);
    std::array<glm::dvec3, 8> found;
    for (size_t i = 0; i < 8; ++i) {
      const auto snapped = snap_beside(view, corners[i], {3, -2});
      ASSERT_TRUE(snapped);
      const bool hidden = i == 0;  // the eye looks at the opposite one
      ASSERT_EQ(snapped->kind == SnapKind::vertex, !hidden) << i;
      if (hidden) continue;
      found[i] = snapped->point;
      expect_near(found[i], corners[i], 1e-5);
    }
    EXPECT_NEAR(glm::distance(found[6], found[7]), 2, 1e-6);
    EXPECT_NEAR(glm::distance(found[5], found[7]), 3, 1e-6);
    EXPECT_NEAR(glm::distance(found[3], found[7]), 4, 1e-6);
    EXPECT_NEAR(angle_degrees(found[6], found[7], found[5]), 90, 1e-4);
    EXPECT_NEAR(polygon_size(std::array{found[7], found[5], found[1], found[3]}).area, 12, 1e-5);
  }
}

TEST_F(PlacedBox, has_edges_and_faces_and_no_diagonals) {
  for (const Affine& transform : placements()) {
    place(transform);
    const glm::dvec3 middle = transform * glm::dvec4(1, 1.5, 2, 1);
    for (const bool orthographic : {false, true}) {
      View view = view_of(transform * glm::dvec4(9, 7, 12, 1), middle);
      if (orthographic) set_orthographic_height(view.camera, 8, 4.0 / 3);
      const glm::dvec3 on_edge = glm::mix(corners[7], corners[3], 0.3);
      const auto edge = snap_beside(view, on_edge, {2, 2});
      ASSERT_TRUE(edge);
      EXPECT_EQ(edge->kind, SnapKind::edge);
      const glm::dvec3 along = glm::normalize(corners[7] - corners[3]);
      EXPECT_LT(glm::length(glm::cross(edge->point - corners[3], along)), 1e-5) << "it is not on the edge";
      EXPECT_LT(glm::distance(edge->point, on_edge), 0.2);
      // The middle of a side lies on the diagonal between its triangles.
      const glm::dvec3 on_face = (corners[7] + corners[1]) * 0.5;
      const auto face = snap_beside(view, on_face, {0, 0});
      ASSERT_TRUE(face);
      EXPECT_EQ(face->kind, SnapKind::face);
      expect_near(face->point, on_face, 1e-5);
      const glm::dvec3 normal = glm::normalize(corners[1] - corners[0]);
      EXPECT_NEAR(std::abs(glm::dot(face->normal, normal)), 1, 1e-6);
      EXPECT_LT(glm::dot(face->normal, view.camera.target - view.camera.eye), 0) << "towards the eye";
      EXPECT_FALSE(snap_beside(view, corners[7], {150, -100})) << "there is nothing";
    }
  }
}

TEST_F(PlacedBox, shows_what_a_section_leaves_of_it) {
  place(Affine(1));
  const View view = view_of({9, 7, 12}, {1, 1.5, 2});
  Section section;
  section.add_plane({{-1, 0, 0}, -1}, "test");  // x up to 1
  const auto snapped = snap_beside(view, corners[7], {1, 1}, section);
  EXPECT_TRUE(!snapped || snapped->point.x < 1 + 1e-6) << "a corner that was cut away";
  const auto kept = snap_beside(view, corners[6], {1, 1}, section);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->kind, SnapKind::vertex);
  expect_near(kept->point, corners[6], 1e-6);
}

TEST(NearCursor, meets_at_full_detail_what_is_shown_coarsely) {
  for (const std::string name : {"room", "instances", "storeys", "far"}) {
    const Pack& pack = scenes::pack(name);
    const Skeleton& skeleton = pack.skeleton();
    Picker picker(pack);
    int hits = 0;
    for (const View& view : scenes::random_views(skeleton, 40, 30, 12, 7)) {
      const Cut coarse = select_cut(FrameView(skeleton, {view, 16}));
      const Cut finest = select_cut(FrameView(skeleton, {view, 0}));
      for (const auto& [x, y] : {std::pair{20.0, 15.0}, {7.5, 9.5}, {33.25, 21.0}}) {
        const NearCursor near(skeleton, picker.chunks(), {view, 16}, coarse.drawables, {x, y}, 3);
        const auto wanted = picker.at({view}, finest.drawables, x, y);
        ASSERT_EQ(near.hit().has_value(), wanted.has_value()) << name;
        if (!wanted) continue;
        ++hits;
        EXPECT_LT(glm::distance(near.hit()->point, wanted->point),
                  1e-6 * (glm::length(wanted->point - view.camera.eye) + glm::length(wanted->point)))
            << name;
        EXPECT_TRUE(near.sees(wanted->point)) << name;
      }
    }
    EXPECT_GT(hits, 6) << name;
  }
}

TEST(Measurement, of_angles_and_areas_keeps_its_digits_far_from_the_origin) {
  const glm::dvec3 far(5'400'000, 120, -3'100'000);
  EXPECT_NEAR(angle_degrees(far + glm::dvec3(1, 0, 0), far, far + glm::dvec3(1, 0, 1)), 45, 1e-9);
  EXPECT_NEAR(angle_degrees({1, 0, 0}, {0, 0, 0}, {-1, 0, 0}), 180, 1e-12);
  EXPECT_EQ(angle_degrees({1, 0, 0}, {1, 0, 0}, {2, 0, 0}), 0);
  std::vector<glm::dvec3> l_shape;  // concave, in a plane that is tilted: 3 of 4 squares
  for (const auto& [x, y] : {std::pair{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})
    l_shape.push_back(far + glm::dvec3(x, 0.6 * y, 0.8 * y));
  const PolygonSize size = polygon_size(l_shape);
  EXPECT_NEAR(size.area, 3, 1e-8);
  EXPECT_NEAR(size.perimeter, 8, 1e-8);
  EXPECT_NEAR(size.off_plane, 0, 1e-8);
  const PolygonSize bent =
      polygon_size(std::array<glm::dvec3, 4>{{{0, 0, 0.1}, {1, 0, -0.1}, {1, 1, 0.1}, {0, 1, -0.1}}});
  EXPECT_NEAR(bent.off_plane, 0.1, 1e-12);
  EXPECT_NEAR(bent.area, 1, 1e-12);
}

TEST(Measurement, numbers_are_read_by_people) {
  EXPECT_EQ(number_text(12.3456), "12.346");
  EXPECT_EQ(number_text(-1'234'567.8912), "-1234567.891");
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(0.00012345), "0.0001234");
  EXPECT_EQ(number_text(1e20), "1e+20");
}

TEST(Measuring, says_distances_angles_and_areas_in_the_model_s_own_coordinates) {
  // Millimetres, z up.
  Measuring measuring({true, 0.001, "mm"});
  measuring.begin();
  const View view = view_of({1, 1, 10}, {1, 1, 0});
  const PictureSpace space(view);
  const auto click = [&](const glm::dvec3& at) {
    measuring.hover(Snap{SnapKind::vertex, at, {}, {}, {}, 0});
    return measuring.click(view, space.pixel(space.from_eye(at)));
  };
  EXPECT_NE(click({0, 0, 0}).find("point 1: x 0, y 0, z 0 mm (corner)"), std::string::npos);
  const std::string second = click({2, 0, -1});
  EXPECT_NE(second.find("point 2: x 2000, y 1000, z 0 mm"), std::string::npos) << second;
  EXPECT_NE(second.find("distance 2236.068 mm, dx 2000.000, dy 1000.000, dz 0"), std::string::npos) << second;
  measuring.take_back();
  click({2, 0, 0});
  const std::string third = click({2, 2, 0});
  EXPECT_NE(third.find("angle 90.000°"), std::string::npos) << third;
  click({0, 2, 0});
  EXPECT_EQ(measuring.points().size(), 4u);
  const std::string closed = click({0, 0, 0});
  EXPECT_NE(closed.find("area 4000000.000 mm²"), std::string::npos) << closed;
  EXPECT_NE(measuring.title().find("area"), std::string::npos);
  EXPECT_TRUE(measuring.take_back()) << "the closing side";
  EXPECT_NE(measuring.title().find("angle"), std::string::npos);
  measuring.end();
  EXPECT_EQ(measuring.title(), "");
  Overlay overlay(view);
  measuring.draw(overlay);
  EXPECT_TRUE(overlay.lines().empty()) << "Esc leaves nothing behind";
}

TEST(Measuring, gives_the_way_to_a_face_at_right_angles) {
  Measuring measuring({});
  measuring.begin();
  const View view = view_of({1, 1, 10}, {1, 1, 0});
  measuring.hover(Snap{SnapKind::vertex, {0, 5, 0}, {}, {}, {}, 0});
  measuring.click(view, {0, 0});
  measuring.hover(Snap{SnapKind::face, {3, 1, 0}, {}, {}, {0, 1, 0}, 0});
  const std::string text = measuring.click(view, {0, 0});
  EXPECT_NE(text.find("distance 5.000 m"), std::string::npos) << text;
  EXPECT_NE(text.find("4.000 m at right angles to that face"), std::string::npos) << text;
}

}  // namespace
}  // namespace triptych
