#include "samples/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

void add_triangle(MeshPart& part, size_t a, size_t b, size_t c) {
  part.indices.insert(part.indices.end(),
                      {static_cast<uint32_t>(a), static_cast<uint32_t>(b), static_cast<uint32_t>(c)});
}

/// Adds the corners; returns the first one's number.
size_t add_corners(MeshPart& part, const std::vector<Outline>& outlines) {
  const size_t first = part.positions.size();
  for (const Outline& outline : outlines)
    for (const glm::dvec3& corner : outline) part.positions.emplace_back(corner);
  return first;
}

/// The band between two outlines, whose corners start at these numbers.
void add_band(MeshPart& part, size_t from, size_t to, size_t sides) {
  for (size_t k = 0; k < sides; ++k) {
    const size_t next = (k + 1) % sides;
    add_triangle(part, from + k, from + next, to + next);
    add_triangle(part, from + k, to + next, to + k);
  }
}

std::vector<Outline> placed_outlines(const std::vector<SweepFrame>& frames, const Profile& profile) {
  std::vector<Outline> outlines;
  for (const SweepFrame& frame : frames) outlines.push_back(placed_outline(frame, profile));
  return outlines;
}

}  // namespace

void add_lofted(MeshPart& part, const std::vector<Outline>& outlines) {
  const size_t first = add_corners(part, outlines), sides = outlines.front().size();
  const size_t last = first + (outlines.size() - 1) * sides;
  for (size_t from = first; from < last; from += sides) add_band(part, from, from + sides, sides);
  for (size_t k = 1; k + 1 < sides; ++k) {
    add_triangle(part, first, first + k + 1, first + k);
    add_triangle(part, last, last + k, last + k + 1);
  }
}

void add_looped(MeshPart& part, const std::vector<Outline>& outlines) {
  const size_t first = add_corners(part, outlines), sides = outlines.front().size();
  for (size_t i = 0; i < outlines.size(); ++i)
    add_band(part, first + i * sides, first + (i + 1) % outlines.size() * sides, sides);
}

Profile circle_profile(double radius, size_t sides) {
  Profile profile;
  for (size_t k = 0; k < sides; ++k) {
    const double turn = glm::two_pi<double>() * static_cast<double>(k) / static_cast<double>(sides);
    profile.emplace_back(radius * std::cos(turn), radius * std::sin(turn));
  }
  return profile;
}

Profile rectangle_profile(double width, double height) {
  const double u = width / 2, v = height / 2;
  return {{u, -v}, {u, v}, {-u, v}, {-u, -v}};
}

Outline placed_outline(const SweepFrame& frame, const Profile& profile) {
  Outline outline;
  for (const glm::dvec2& corner : profile)
    outline.push_back(frame.centre + corner.x * frame.u + corner.y * frame.v);
  return outline;
}

std::vector<SweepFrame> straight_frames(double length) {
  SweepFrame end;
  end.centre.x = length;
  return {SweepFrame(), end};
}

std::vector<SweepFrame> bend_frames(double radius, size_t steps) {
  std::vector<SweepFrame> frames;
  for (size_t k = 0; k <= steps; ++k) {
    const double turn = glm::half_pi<double>() * static_cast<double>(k) / static_cast<double>(steps);
    const double s = std::sin(turn), c = std::cos(turn);
    frames.push_back({{radius * (s - 1), radius * (1 - c), 0}, {-s, c, 0}, {0, 0, 1}});
  }
  return frames;
}

void add_solid(MeshPart& part, const std::vector<SweepFrame>& frames, const Profile& profile) {
  add_lofted(part, placed_outlines(frames, profile));
}

void add_hollow(MeshPart& part, const std::vector<SweepFrame>& frames, const Profile& outer,
                const Profile& inner) {
  std::vector<Outline> outlines = placed_outlines(frames, outer);
  std::vector<SweepFrame> back(frames.rbegin(), frames.rend());
  for (Outline& outline : placed_outlines(back, inner)) outlines.push_back(std::move(outline));
  add_looped(part, outlines);
}

void add_round(MeshPart& part, const std::vector<Ring>& rings, size_t sides) {
  std::vector<Outline> outlines;
  glm::dvec3 across(0);
  for (size_t i = 0; i < rings.size(); ++i) {
    glm::dvec3 along = rings[std::min(i + 1, rings.size() - 1)].centre - rings[i - (i > 0)].centre;
    // Rings at one place are steps of a turned body.
    if (glm::length(along) < 1e-9) along = rings.back().centre - rings.front().centre;
    along = glm::normalize(along);
    if (i == 0) across = std::abs(along.y) < 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    across = glm::normalize(across - along * glm::dot(across, along));
    const glm::dvec3 third = glm::cross(along, across);
    Outline outline;
    for (size_t k = 0; k < sides; ++k) {
      const double turn = glm::two_pi<double>() * static_cast<double>(k) / static_cast<double>(sides);
      outline.push_back(rings[i].centre +
                        rings[i].radius * (std::cos(turn) * across + std::sin(turn) * third));
    }
    outlines.push_back(std::move(outline));
  }
  add_lofted(part, outlines);
}

}  // namespace triptych
