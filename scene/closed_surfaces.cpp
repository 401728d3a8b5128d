#include "scene/closed_surfaces.hpp"

#include "base/bytes.hpp"
#include "scene/placed_box.hpp"
#include "scene/skeleton.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace triptych {

namespace {

/// The indices of runs by chunk, and within a chunk by their triangles.
std::vector<uint32_t> sorted_by_chunk(std::span<const ClosedRun> runs) {
  std::vector<uint32_t> order(runs.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](uint32_t i) { return std::tuple(runs[i].chunk, runs[i].first_triangle); });
  return order;
}

void check_apart(const ClosedSurfaces& closed, const std::string& place) {
  uint32_t chunk = no_id, end = 0;
  for (const uint32_t i : sorted_by_chunk(closed.runs)) {
    const ClosedRun& run = closed.runs[i];
    if (run.chunk != chunk) end = closed.in_chunk(run.chunk);
    if (run.first_triangle < end)
      fail(place, "has triangle {} of chunk {} twice", run.first_triangle, run.chunk);
    chunk = run.chunk;
    end = run.first_triangle + run.triangle_count;
  }
}

}  // namespace

std::span<const uint32_t> ClosedSurfaces::runs_in(uint32_t chunk) const {
  if (first_in_chunk_.empty()) return {};
  const uint32_t first = first_in_chunk_[chunk];
  return std::span(by_chunk_).subspan(first, first_in_chunk_[chunk + 1] - first);
}

bool ClosedSurfaces::are_all_of(uint32_t chunk, const ChunkInfo& info) const {
  uint32_t triangles = in_chunk(chunk);
  for (const uint32_t run : runs_in(chunk)) triangles += runs[run].triangle_count;
  return triangles == info.triangle_count;
}

const LatticeBox& ClosedSurfaces::reach(uint32_t scene_node, const SceneNode& node) const {
  return reach_.empty() ? node.box : reach_[scene_node];
}

void ClosedSurfaces::find_reach(const Skeleton& skeleton) {
  first_in_chunk_.clear();
  by_chunk_.clear();
  reach_.clear();
  if (bodies.empty()) return;
  first_in_chunk_.assign(skeleton.chunks.size() + 1, 0);
  for (const ClosedRun& run : runs) ++first_in_chunk_[run.chunk + 1];
  std::partial_sum(first_in_chunk_.begin(), first_in_chunk_.end(), first_in_chunk_.begin());
  by_chunk_ = sorted_by_chunk(runs);
  reach_.reserve(skeleton.scene_nodes.size());
  for (const SceneNode& node : skeleton.scene_nodes) {
    LatticeBox& box = reach_.emplace_back(node.box);
    if (node.child_count > 0 || node.drawable_count == 0) continue;
    const Drawable& finest = skeleton.drawables[node.first_drawable];
    for (uint32_t i = 0; i < finest.placement_count; ++i) {
      const Placement& placement = skeleton.placements[finest.first_placement + i];
      for (const uint32_t run : runs_in(placement.chunk))
        box.extend(placed_body(skeleton, bodies[runs[run].body], skeleton.transforms[placement.transform]));
    }
  }
  for (size_t i = reach_.size(); i-- > 1;) reach_[skeleton.scene_nodes[i].parent].extend(reach_[i]);
}

LatticeBox placed_body(const Skeleton& skeleton, const DividedBody& body, const Affine& transform) {
  const uint32_t lattice = skeleton.chunks[skeleton.closed.runs[body.first_run].chunk].lattice;
  return placed_box(skeleton, lattice, transform, body.box, skeleton.scene_nodes.front().box);
}

std::vector<std::byte> encode_closed_surfaces(const ClosedSurfaces& closed) {
  ByteWriter writer;
  const auto& counts = closed.in_chunks;
  writer.write(static_cast<uint32_t>(counts.size() - static_cast<size_t>(std::ranges::count(counts, 0u))));
  for (uint32_t chunk = 0; chunk < counts.size(); ++chunk) {
    if (counts[chunk] == 0) continue;
    writer.write(chunk);
    writer.write(counts[chunk]);
  }
  writer.write(static_cast<uint32_t>(closed.bodies.size()));
  for (const DividedBody& body : closed.bodies) {
    writer.write(body.box);
    writer.write(body.run_count);
    for (const ClosedRun& run : std::span(closed.runs).subspan(body.first_run, body.run_count)) {
      writer.write(run.chunk);
      writer.write(run.first_triangle);
      writer.write(run.triangle_count);
    }
  }
  return std::move(writer.bytes());
}

ClosedSurfaces decode_closed_surfaces(std::span<const std::byte> bytes, std::span<const ChunkInfo> chunks,
                                      const std::string& place) {
  ByteReader reader(bytes, place);
  ClosedSurfaces closed;
  /// Of a chunk from `least` on.
  const auto read_chunk = [&](size_t least) {
    const size_t at = reader.offset();
    const auto chunk = reader.read<uint32_t>();
    if (chunk < least || chunk >= chunks.size())
      fail(place, "byte {}: chunk {} is not one of those that may follow", at, chunk);
    return chunk;
  };
  const auto read_count = [&](uint32_t most) {
    const size_t at = reader.offset();
    const auto count = reader.read<uint32_t>();
    if (count == 0 || count > most) fail(place, "byte {}: {} triangles where there are {}", at, count, most);
    return count;
  };
  const auto closed_chunks = reader.read<uint32_t>();
  if (closed_chunks > 0) closed.in_chunks.assign(chunks.size(), 0);
  size_t least = 0;
  for (uint32_t i = 0; i < closed_chunks; ++i) {
    const uint32_t chunk = read_chunk(least);
    closed.in_chunks[chunk] = read_count(chunks[chunk].triangle_count);
    least = size_t{chunk} + 1;
  }
  const auto body_count = reader.read<uint32_t>();
  for (uint32_t i = 0; i < body_count; ++i) {
    const size_t at = reader.offset();
    DividedBody body{.box = reader.read<LatticeBox>(),
                     .first_run = static_cast<uint32_t>(closed.runs.size()),
                     .run_count = reader.read<uint32_t>()};
    constexpr int farthest = 1 << 29;
    if (body.box.empty() || glm::any(glm::lessThan(body.box.lo, glm::ivec3(-farthest))) ||
        glm::any(glm::greaterThan(body.box.hi, glm::ivec3(farthest))))
      fail(place, "byte {}: the box of body {} is empty, or leaves the lattice", at, i);
    if (body.run_count == 0) fail(place, "byte {}: body {} has no triangles", at, i);
    least = 0;
    for (uint32_t run = 0; run < body.run_count; ++run) {
      const uint32_t chunk = read_chunk(least);
      const auto first = reader.read<uint32_t>();
      const uint32_t triangles = chunks[chunk].triangle_count;
      closed.runs.push_back({chunk, first, read_count(first < triangles ? triangles - first : 0), i});
      least = size_t{chunk} + 1;
      if (chunks[chunk].lattice != chunks[closed.runs[body.first_run].chunk].lattice)
        fail(place, "body {} is on the lattices of chunks {} and {}", i, closed.runs[body.first_run].chunk,
             chunk);
    }
    closed.bodies.push_back(body);
  }
  reader.expect_end();
  check_apart(closed, place);
  return closed;
}

}  // namespace triptych
