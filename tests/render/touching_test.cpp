// A closed surface that is many objects, which only touch: no gap opens between them at any mix of levels.
#include "tests/render/closed_scenes.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/scenes.hpp"

#include <map>
#include <tuple>

namespace triptych {
namespace {

using test::holes_of_random_mixes;
using test::pack_of;

constexpr Kept nothing = {.touching = false, .order = false, .planes = false, .cover = false};

/// The mesh as one mesh for each octant and shell of triangles, each with points of its own.
Model in_objects(const Mesh& whole) {
  std::map<std::tuple<bool, bool, bool, int>, Mesh> objects;
  for (const Triangle& triangle : whole.triangles) {
    glm::dvec3 centre(0);
    for (const uint32_t corner : triangle.vertices) centre += whole.positions[corner] / 3.0;
    const int band = static_cast<int>(std::floor(centre.y / 4));
    Mesh& object = objects[{centre.x > 0, centre.z > 0, std::abs(centre.x) > std::abs(centre.z), band}];
    Triangle own = triangle;
    for (uint32_t& corner : own.vertices) {
      object.positions.push_back(whole.positions[corner]);
      corner = static_cast<uint32_t>(object.positions.size() - 1);
    }
    object.triangles.push_back(own);
  }
  std::vector<Mesh> meshes;
  for (auto& [key, object] : objects) meshes.push_back(std::move(object));
  return awkward::model_of(std::move(meshes));
}

TEST(Touching, objects_that_share_points_show_no_gap_at_any_mix_of_levels) {
  const Model model = in_objects(awkward::wavy_sphere(120));
  EXPECT_GT(model.meshes.size(), 30u);
  EXPECT_GT(holes_of_random_mixes(*pack_of(model, Simplifier::collapse, nothing), 60), 0u)
      << "nothing to keep";
  EXPECT_EQ(holes_of_random_mixes(*pack_of(model), 120), 0u);
}

/// One mesh of all of them, whose points are off by up to so much along each axis.
Model in_one_mesh(const Model& objects, double off) {
  scenes::Random randomly(3);
  Mesh whole;
  for (const Mesh& object : objects.meshes) {
    const auto first = static_cast<uint32_t>(whole.positions.size());
    for (const glm::dvec3& position : object.positions)
      whole.positions.push_back(position + randomly.vector(-off, off));
    for (Triangle triangle : object.triangles) {
      for (uint32_t& corner : triangle.vertices) corner += first;
      whole.triangles.push_back(triangle);
    }
  }
  std::vector<Mesh> meshes;
  meshes.push_back(std::move(whole));
  return awkward::model_of(std::move(meshes));
}

TEST(Touching, pieces_of_one_mesh_that_are_off_by_what_single_precision_is_show_no_gap) {
  // The sphere is 20 across: 2^-20 are a few steps of its lattice.
  const Model model = in_one_mesh(in_objects(awkward::wavy_sphere(45)), 0x1p-20);
  EXPECT_GT(holes_of_random_mixes(*pack_of(model, Simplifier::collapse, nothing), 60), 0u)
      << "nothing to keep";
  EXPECT_EQ(holes_of_random_mixes(*pack_of(model), 120), 0u);
}

TEST(Touching, whoever_simplifies_them) {
  const Model model = in_objects(awkward::wavy_sphere(80));
  for (const Simplifier simplifier : {Simplifier::openmesh, Simplifier::meshopt})
    EXPECT_EQ(holes_of_random_mixes(*pack_of(model, simplifier), 40), 0u);
}

/// A quarter of a sphere of radius 10 about y, from x to z, wavy but for its borders, which are circles.
Mesh quarter(uint32_t rings) {
  Mesh mesh{.name = "quarter", .positions = {}, .triangles = {}};
  const uint32_t row = rings + 1;
  for (uint32_t i = 0; i <= rings; ++i) {
    for (uint32_t k = 0; k <= rings; ++k) {
      const double polar = glm::pi<double>() * i / rings, turn = glm::half_pi<double>() * k / rings;
      // Exactly the same on both borders but for the axes.
      const double c = k == rings ? 0 : std::cos(turn), s = k == 0 ? 0 : k == rings ? 1 : std::sin(turn);
      const double bump = 1 + 0.04 * std::sin(2 * turn) * std::sin(2 * turn) * std::sin(9 * polar);
      mesh.positions.push_back(10 * bump *
                               glm::dvec3(std::sin(polar) * c, std::cos(polar), std::sin(polar) * s));
    }
  }
  for (uint32_t i = 0; i < rings; ++i) {
    for (uint32_t k = 0; k < rings; ++k) {
      const uint32_t at = i * row + k;
      mesh.triangles.push_back({{at, at + 1, at + row}, 0});
      mesh.triangles.push_back({{at + 1, at + row + 1, at + row}, 0});
    }
  }
  return mesh;
}

TEST(Touching, placements_of_one_mesh_show_no_gap_either) {
  Model model = awkward::model_of({quarter(48)});
  model.instances.clear();
  for (int i = 0; i < 4; ++i) {
    const double c[] = {1, 0, -1, 0}, s[] = {0, 1, 0, -1};
    model.instances.push_back({0, Affine({c[i], 0, s[i]}, {0, 1, 0}, {-s[i], 0, c[i]}, glm::dvec3(0))});
  }
  EXPECT_GT(holes_of_random_mixes(*pack_of(model, Simplifier::collapse, nothing), 60), 0u);
  EXPECT_EQ(holes_of_random_mixes(*pack_of(model), 120), 0u);
}

/// A wall of a cube of 20 with its centre at the origin: a grid of n x n, bumped inside; `turned` to its
/// side.
Mesh wall(uint32_t n, const glm::dmat3& turned) {
  Mesh mesh{.name = "wall", .positions = {}, .triangles = {}};
  for (uint32_t i = 0; i <= n; ++i) {
    for (uint32_t k = 0; k <= n; ++k) {
      const double x = 20.0 * i / n - 10, y = 20.0 * k / n - 10;
      const bool border = i == 0 || k == 0 || i == n || k == n;
      const double z = border ? 10 : 10 + 0.4 * std::sin(x) * std::cos(1.3 * y);
      mesh.positions.push_back(turned * glm::dvec3(x, y, z));
    }
  }
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t k = 0; k < n; ++k) {
      const uint32_t at = i * (n + 1) + k;
      mesh.triangles.push_back({{at, at + n + 1, at + 1}, 0});
      mesh.triangles.push_back({{at + 1, at + n + 1, at + n + 2}, 0});
    }
  }
  return mesh;
}

TEST(Touching, points_on_the_edges_of_others_stay_on_them) {
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  // Along each edge of the cube the points of one wall lie between those of the other.
  const Model model = awkward::model_of({wall(48, {x, y, z}), wall(32, {x, -y, -z}), wall(24, {y, z, x}),
                                         wall(40, {-y, z, -x}), wall(64, {z, x, y}), wall(56, {z, -x, -y})});
  const size_t loose = holes_of_random_mixes(*pack_of(model, Simplifier::collapse, nothing), 60);
  const size_t kept = holes_of_random_mixes(*pack_of(model), 60);
  EXPECT_GT(loose, 500u);
  // A point that is snapped to 1/256 pixel may leave the other's edge by as much: single pixels.
  EXPECT_LE(kept, 60 * 320 * 240 / 100'000) << loose << " without";
}

}  // namespace
}  // namespace triptych
