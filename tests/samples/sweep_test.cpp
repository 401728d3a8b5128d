// Bodies that outlines make when they move are closed surfaces that face outward.
#include "samples/sweep.hpp"

#include "tests/samples/mesh_edges.hpp"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

Faces faces_of(const MeshPart& part) {
  Faces faces;
  for (size_t i = 0; i < part.indices.size(); i += 3)
    faces.push_back({part.indices[i], part.indices[i + 1], part.indices[i + 2]});
  return faces;
}

void expect_closed(const MeshPart& part, size_t triangles, double volume) {
  const Faces faces = faces_of(part);
  EXPECT_EQ(faces.size(), triangles);
  for (const auto& [edge, use] : edges_of(faces)) {
    EXPECT_EQ(use.forwards, 1);
    EXPECT_EQ(use.backwards, 1);
  }
  EXPECT_NEAR(volume_of(part.positions, faces), volume, 1e-4 * volume);
}

double circle_area(double radius, size_t sides) {
  const auto n = static_cast<double>(sides);
  return n / 2 * radius * radius * std::sin(glm::two_pi<double>() / n);
}

TEST(Sweep, a_straight_pipe_has_two_walls_and_the_volume_between_them) {
  MeshPart part;
  add_hollow(part, straight_frames(3), circle_profile(0.5, 12), circle_profile(0.4, 12));
  expect_closed(part, 4 * 2 * 12, 3 * (circle_area(0.5, 12) - circle_area(0.4, 12)));
}

TEST(Sweep, a_solid_bar_is_closed_at_both_ends) {
  MeshPart part;
  add_solid(part, straight_frames(2), rectangle_profile(0.5, 0.25));
  expect_closed(part, 12, 2 * 0.5 * 0.25);
}

TEST(Sweep, a_bend_leads_from_x_to_y_around_the_origin_and_faces_outward) {
  const auto frames = bend_frames(1, 8);
  EXPECT_NEAR(glm::distance(frames.front().centre, glm::dvec3(-1, 0, 0)), 0, 1e-12);
  EXPECT_NEAR(glm::distance(frames.back().centre, glm::dvec3(0, 1, 0)), 0, 1e-12);
  const glm::dvec3 in = glm::cross(frames.front().u, frames.front().v),
                   out = glm::cross(frames.back().u, frames.back().v);
  EXPECT_NEAR(glm::distance(in, glm::dvec3(1, 0, 0)), 0, 1e-12);
  EXPECT_NEAR(glm::distance(out, glm::dvec3(0, 1, 0)), 0, 1e-12);
  MeshPart part;
  add_hollow(part, frames, circle_profile(0.2, 16), circle_profile(0.15, 16));
  EXPECT_EQ(part.indices.size() / 3, 2u * 16 * (8 + 8 + 2));
  for (const auto& [edge, use] : edges_of(faces_of(part))) EXPECT_EQ(use.forwards + use.backwards, 2);
  // By Pappus, but for the corners that eight steps cut off.
  const double whole = glm::half_pi<double>() * (circle_area(0.2, 16) - circle_area(0.15, 16));
  EXPECT_NEAR(volume_of(part.positions, faces_of(part)), whole, 0.02 * whole);
}

TEST(Sweep, a_turned_body_whose_ends_meet_the_ring_is_closed) {
  MeshPart part;
  add_round(part, {{{0, 0, 0}, 0.5}, {{0, 1, 0}, 0.5}}, 8);
  expect_closed(part, 2 * 8 + 2 * 6, circle_area(0.5, 8));
}

}  // namespace
}  // namespace triptych
