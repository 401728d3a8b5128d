#include "preprocess/triangle_objects.hpp"

#include "base/bytes.hpp"
#include "scene/stored_objects.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tsl/robin_map.h>

namespace triptych {

namespace {

double area_of(const Surface& surface, const Triangle& triangle) {
  std::array<glm::dvec3, 3> corners;
  for (size_t i = 0; i < 3; ++i) corners[i] = surface.points[triangle.vertices[i]];
  return glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0])) / 2;
}

}  // namespace

TriangleObjects::TriangleObjects(const Baked& geometry) {
  if (geometry.objects.empty()) return;
  struct Corner {
    uint32_t point;
    SourceObjectId object;
    double area;
  };
  const Surface& surface = geometry.surface;
  std::vector<Corner> corners;
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    const double area = area_of(surface, surface.triangles[i]);
    for (const uint32_t vertex : surface.triangles[i].vertices)
      corners.push_back({vertex, geometry.objects[i], area});
  }
  std::stable_sort(corners.begin(), corners.end(), [](const Corner& one, const Corner& other) {
    return one.point != other.point ? one.point < other.point : one.object < other.object;
  });
  first_shares_.assign(surface.points.size() + 1, 0);
  for (size_t i = 0; i < corners.size(); ++i) {
    const bool same =
        i > 0 && corners[i].point == corners[i - 1].point && corners[i].object == corners[i - 1].object;
    if (!same) {
      shares_.push_back({corners[i].object, 0});
      ++first_shares_[corners[i].point + 1];
    }
    shares_.back().area += corners[i].area;
  }
  for (size_t i = 1; i < first_shares_.size(); ++i) first_shares_[i] += first_shares_[i - 1];
}

std::span<const TriangleObjects::Share> TriangleObjects::shares_at(uint32_t point) const {
  return std::span(shares_).subspan(first_shares_[point], first_shares_[point + 1] - first_shares_[point]);
}

SourceObjectId TriangleObjects::of(const std::array<uint32_t, 3>& corners) const {
  struct Candidate {
    SourceObjectId object;
    int corners;
    double area;
  };
  std::vector<Candidate> candidates;
  for (const uint32_t corner : corners) {
    for (const Share& share : shares_at(corner)) {
      const auto known = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
        return candidate.object == share.object;
      });
      if (known == candidates.end()) {
        candidates.push_back({share.object, 1, share.area});
      } else {
        ++known->corners;
        known->area += share.area;
      }
    }
  }
  const auto best = std::max_element(candidates.begin(), candidates.end(),
                                     [](const Candidate& one, const Candidate& other) {
                                       if (one.corners != other.corners) return one.corners < other.corners;
                                       if (one.area != other.area) return one.area < other.area;
                                       return one.object > other.object;
                                     });
  return best == candidates.end() ? no_id : best->object;
}

std::vector<SourceObjectId> TriangleObjects::of(const Piece& level) const {
  std::vector<SourceObjectId> objects;
  if (shares_.empty()) return objects;
  for (const Triangle& triangle : level.surface.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    objects.push_back(of({level.sources[a], level.sources[b], level.sources[c]}));
  }
  return objects;
}

std::vector<std::byte> TriangleObjects::encoded(const Piece& piece, const EncodedChunk& level) const {
  if (shares_.empty()) return {};
  tsl::robin_map<glm::ivec3, uint32_t, KeyHash> sources;
  for (size_t i = 0; i < piece.sources.size(); ++i)
    sources.try_emplace(piece.surface.points[i], piece.sources[i]);
  ChunkInfo info;
  info.vertex_count = level.vertices, info.triangle_count = level.triangles, info.box = level.box;
  const std::span<const LatticeBox> pieces =
      level.pieces.empty() ? std::span(&level.box, 1) : std::span<const LatticeBox>(level.pieces);
  const Chunk chunk = decode_chunk(level.bytes, info, pieces, max_colors, "a level of an inner scene node");
  std::vector<SourceObjectId> objects;
  for (size_t i = 0; i < chunk.indices.size(); i += 3) {
    const auto source = [&](size_t corner) {
      return sources.at(chunk.vertices[chunk.indices[i + corner]].point);
    };
    objects.push_back(of({source(0), source(1), source(2)}));
  }
  return encode_triangle_objects(objects);
}

std::vector<std::byte> encode_triangle_objects(std::span<const SourceObjectId> objects) {
  ByteWriter writer;
  SourceObjectId before = 0;
  for (size_t i = 0; i < objects.size();) {
    size_t end = i;
    while (end < objects.size() && objects[end] == objects[i]) ++end;
    const uint64_t count = end - i - 1;
    const auto step = static_cast<int32_t>(objects[i] - before);  // modulo 2^32
    const uint32_t zigzag = static_cast<uint32_t>(step) << 1 ^ static_cast<uint32_t>(step >> 31);
    writer.write_varint(uint64_t{zigzag} << run_count_bits | std::min(count, long_run));
    if (count >= long_run) writer.write_varint(count - long_run);
    before = objects[i];
    i = end;
  }
  return std::move(writer.bytes());
}

}  // namespace triptych
