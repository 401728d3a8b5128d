// Surfaces made slice by slice: as many triangles as asked for, closed, the same for any number of threads.
#include "base/error.hpp"
#include "base/threads.hpp"
#include "samples/surfaces/isosurface.hpp"
#include "samples/surfaces/statue.hpp"
#include "scene/path.hpp"
#include "tests/samples/mesh_edges.hpp"
#include "tests/samples/sample_files.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

struct Surface {
  std::vector<glm::dvec3> positions;
  Faces faces;
};

Surface read_surface(const std::filesystem::path& file) {
  const Model model = read_whole(file);
  EXPECT_EQ(model.meshes.size(), 1u);
  EXPECT_EQ(model.report.dropped_triangles, 0u);
  Surface surface{model.meshes[0].positions, {}};
  for (const Triangle& triangle : model.meshes[0].triangles) surface.faces.push_back(triangle.vertices);
  return surface;
}

class Ball : public Field {
 public:
  void evaluate(const SampleRow& row, std::span<float> values) const override {
    for (size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<float>(
          glm::length(glm::dvec3(row.x + static_cast<double>(i) * row.step, row.y, row.z)) - 1);
  }
};

TEST(Polygoniser, a_ball_is_one_closed_outward_surface_of_its_size) {
  const Folder folder("ball");
  const auto make = [](double) { return std::make_unique<Ball>(); };
  const SurfaceReport report =
      write_surface(make, {-1.3, -1.2, -1.1}, {1.3, 1.2, 1.1}, 40'000, folder.path(), "ball");
  EXPECT_NEAR(double(report.triangles), 40'000, 4'000);
  const Surface ball = read_surface(folder.path() / "scene.ply");
  EXPECT_EQ(ball.faces.size(), report.triangles);
  EXPECT_EQ(ball.positions.size(), report.vertices);
  const auto edges = edges_of(ball.faces);
  for (const auto& [edge, use] : edges) {
    ASSERT_EQ(use.forwards, 1);
    ASSERT_EQ(use.backwards, 1);
  }
  EXPECT_EQ(ball.positions.size() + ball.faces.size() - edges.size(), 2u) << "Euler: a sphere";
  EXPECT_NEAR(volume_of(ball.positions, ball.faces), 4 * glm::pi<double>() / 3, 0.01);
  for (const auto& position : ball.positions) EXPECT_NEAR(glm::length(position), 1, 0.01);
}

TEST(Polygoniser, noise_in_a_row_is_the_noise_at_its_points) {
  const NoiseOctave octave{3.7, 0.8, 11};
  std::vector<float> values(200, 0.25f);
  add_noise(octave, {-2.1, 0.3, -7.7, 0.031}, values);
  for (size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], 0.25 + noise_at(octave, {-2.1 + 0.031 * double(i), 0.3, -7.7}), 2e-5) << i;
}

TEST(Statue, it_is_one_closed_figure_of_as_many_triangles_as_asked_for) {
  for (const uint64_t wanted : {20'000u, 80'000u}) {
    const Folder folder("statue");
    const SurfaceReport report = make_statue({wanted, 1}, folder.path());
    EXPECT_NEAR(double(report.triangles), double(wanted), 0.1 * double(wanted));
    const Surface statue = read_surface(folder.path() / "scene.ply");
    ASSERT_EQ(statue.faces.size(), report.triangles);
    const auto edges = edges_of(statue.faces);
    for (const auto& [edge, use] : edges) {
      ASSERT_EQ(use.forwards, 1);
      ASSERT_EQ(use.backwards, 1);
    }
    EXPECT_EQ(pieces_of(statue.positions.size(), statue.faces), 1u);
    const auto euler = static_cast<int64_t>(statue.positions.size() + statue.faces.size()) -
                       static_cast<int64_t>(edges.size());
    EXPECT_LE(1 - euler / 2, 8) << "few handles";
    EXPECT_GT(volume_of(statue.positions, statue.faces), 0.1);
    std::set<std::tuple<double, double, double>> places;
    for (const auto& p : statue.positions) places.insert({p.x, p.y, p.z});
    EXPECT_EQ(places.size(), statue.positions.size()) << "no two vertices coincide";
  }
}

TEST(Isosurface, it_is_open_only_at_the_sides_of_the_domain_and_full_of_holes) {
  const Folder folder("isosurface");
  const SurfaceReport report = make_isosurface({150'000, 1}, folder.path());
  EXPECT_NEAR(double(report.triangles), 150'000, 15'000);
  const Surface surface = read_surface(folder.path() / "scene.ply");
  ASSERT_EQ(surface.faces.size(), report.triangles);
  const auto edges = edges_of(surface.faces);
  size_t open = 0;
  for (const auto& [edge, use] : edges) {
    ASSERT_LE(use.forwards, 1);
    ASSERT_LE(use.backwards, 1);
    if (use.forwards + use.backwards == 2) continue;
    ++open;
    const auto &a = surface.positions[edge.first], &b = surface.positions[edge.second];
    bool at_side = false;
    for (const int axis : {0, 2})
      for (const double side : {report.low[axis], report.high[axis]})
        at_side |= std::abs(a[axis] - side) < 1e-6 && std::abs(b[axis] - side) < 1e-6;
    ASSERT_TRUE(at_side);
  }
  EXPECT_GT(open, 100u);
  const auto euler = static_cast<int64_t>(surface.positions.size() + surface.faces.size()) -
                     static_cast<int64_t>(edges.size());
  const auto drops = static_cast<int64_t>(pieces_of(surface.positions.size(), surface.faces)) - 1;
  EXPECT_GT(drops, 10);
  EXPECT_LT(euler - 2 * drops, -30) << "of the largest piece: many tunnels";
}

TEST(Isosurface, a_seed_decides_everything_whatever_the_threads) {
  const Folder one("one"), same("same"), other("other");
  make_isosurface({20'000, 4}, one.path());
  set_thread_count(1);
  make_isosurface({20'000, 4}, same.path());
  set_thread_count(0);
  make_isosurface({20'000, 5}, other.path());
  for (const char* file : {"scene.ply", "walk.json", "fly.json", "spin.json", "jump.json"}) {
    EXPECT_EQ(read_file(one.path() / file), read_file(same.path() / file)) << file;
  }
  for (const char* path : {"walk.json", "fly.json", "spin.json", "jump.json"})
    EXPECT_FALSE(load_path(one.path() / path).frames.empty()) << path;
  EXPECT_NE(read_file(one.path() / "scene.ply"), read_file(other.path() / "scene.ply"));
}

TEST(Surfaces, a_number_of_triangles_out_of_range_is_an_error) {
  EXPECT_THROW(make_statue({10, 1}, "nowhere"), Error);
  EXPECT_THROW(make_isosurface({600'000'000, 1}, "nowhere"), Error);
  EXPECT_FALSE(std::filesystem::exists("nowhere"));
}

TEST(PlyWriter, without_finish_there_is_no_file_and_nothing_is_left) {
  const Folder folder("ply");
  make_folder(folder.path());
  {
    PlyWriter writer(folder.path() / "a.ply", "test");
    writer.add_vertices(std::array<glm::vec3, 3>{});
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(PlyWriter, faces_may_come_before_their_vertices) {
  const Folder folder("order");
  make_folder(folder.path());
  PlyWriter writer(folder.path() / "a.ply", "test");
  writer.add_faces(std::array<std::array<uint32_t, 3>, 1>{{{2, 0, 1}}});
  writer.add_vertices(std::array<glm::vec3, 3>{{{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}});
  writer.finish();
  const Surface read = read_surface(folder.path() / "a.ply");
  ASSERT_EQ(read.faces.size(), 1u);
  const auto corner = [&](size_t i) { return read.positions[read.faces[0][i]]; };
  EXPECT_EQ(corner(0), glm::dvec3(7, 8, 10));
  EXPECT_EQ(corner(1), glm::dvec3(1, 2, 3));
  EXPECT_EQ(corner(2), glm::dvec3(4, 5, 6));
}

}  // namespace
}  // namespace triptych
