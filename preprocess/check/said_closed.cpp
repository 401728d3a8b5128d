#include "preprocess/check/said_closed.hpp"

namespace triptych {

namespace {

std::array<glm::ivec3, 3> corners_of(const Chunk& chunk, size_t triangle) {
  const auto at = [&](size_t k) { return chunk.vertices[chunk.indices[3 * triangle + k]].point; };
  return {at(0), at(1), at(2)};
}

}  // namespace

SaidClosed::SaidClosed(const Skeleton& skeleton)
    : skeleton_(skeleton),
      alone_(skeleton.chunks.size()),
      divided_(skeleton.closed.runs.size()),
      leaves_box_(divided_.size()) {}

void SaidClosed::add(uint32_t number, const Chunk& chunk) {
  const ClosedSurfaces& closed = skeleton_.closed;
  for (uint32_t i = 0; i < closed.in_chunk(number); ++i) alone_[number].add(corners_of(chunk, i));
  for (const uint32_t i : closed.runs_in(number)) {
    const ClosedRun& run = closed.runs[i];
    LatticeBox box;
    for (uint32_t k = 0; k < run.triangle_count; ++k) {
      const auto corners = corners_of(chunk, run.first_triangle + k);
      divided_[i].add(corners);
      for (const glm::ivec3& corner : corners) box.extend(corner);
    }
    leaves_box_[i] = !closed.bodies[run.body].box.contains(box);
  }
}

std::vector<uint32_t> SaidClosed::open_chunks() const {
  std::vector<uint32_t> open;
  for (uint32_t i = 0; i < alone_.size(); ++i) {
    if (!alone_[i].is_closed()) open.push_back(i);
  }
  return open;
}

std::vector<uint32_t> SaidClosed::open_bodies() const {
  const ClosedSurfaces& closed = skeleton_.closed;
  std::vector<uint32_t> open;
  for (uint32_t i = 0; i < closed.bodies.size(); ++i) {
    EdgeSum sum;
    bool leaves = false;
    for (uint32_t run = closed.bodies[i].first_run;
         run < closed.bodies[i].first_run + closed.bodies[i].run_count; ++run) {
      sum.add(divided_[run]);
      leaves = leaves || leaves_box_[run] != 0;
    }
    if (leaves || !sum.is_closed()) open.push_back(i);
  }
  return open;
}

}  // namespace triptych
