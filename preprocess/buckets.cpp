#include "preprocess/buckets.hpp"

#include "scene/box.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace triptych {

namespace {

constexpr uint64_t max_sample = 1u << 20;
constexpr size_t buffered_triangles = 768;

bool before(const glm::ivec3& a, const glm::ivec3& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

void sort_unique(std::vector<glm::ivec3>& points) {
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

glm::ivec3 center_of(const LatticeTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  // Corners lie within 2^29: the sum fits.
  return (a + b + c) / 3;
}

}  // namespace

std::optional<uint32_t> number_in(std::span<const SharedPoint> shared, const glm::ivec3& point) {
  const auto found =
      std::lower_bound(shared.begin(), shared.end(), point,
                       [](const SharedPoint& a, const glm::ivec3& b) { return before(a.point, b); });
  if (found == shared.end() || found->point != point) return std::nullopt;
  return found->number;
}

Buckets::Buckets(const Read& read, uint64_t total, uint64_t limit, const CornerStreams& streams,
                 SpoolFile& spool)
    : triangle_bytes_(streams.light         ? sizeof(LatticeTriangle)
                      : streams.coordinates ? offsetof(LatticeTriangle, light)
                      : streams.normals     ? offsetof(LatticeTriangle, coordinates)
                      : streams.colors      ? offsetof(LatticeTriangle, corner_normals)
                                            : offsetof(LatticeTriangle, corner_colors)),
      spool_(spool) {
  const uint64_t every = total / max_sample + 1;
  std::vector<glm::ivec3> sample;
  read(every, [&](std::span<const LatticeTriangle> batch) {
    for (const LatticeTriangle& triangle : batch) sample.push_back(center_of(triangle));
  });
  split(sample, std::max<uint64_t>(limit / every, 1));
  sample = {};
  distribute(read);
}

uint32_t Buckets::split(std::span<glm::ivec3> sample, uint64_t limit) {
  const auto index = static_cast<uint32_t>(splits_.size());
  splits_.emplace_back();
  LatticeBox box;
  for (const glm::ivec3& center : sample) box.extend(center);
  const int axis = sample.empty() ? 0 : box.longest_axis();
  if (sample.size() <= limit || box.lo[axis] == box.hi[axis]) {
    splits_[index].first = static_cast<uint32_t>(places_.size());
    places_.emplace_back();
    return index;
  }
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end(),
                   [&](const glm::ivec3& a, const glm::ivec3& b) { return a[axis] < b[axis]; });
  const int at = std::max((*middle)[axis], box.lo[axis] + 1);
  const auto above = std::partition(sample.begin(), sample.end(),
                                    [&](const glm::ivec3& center) { return center[axis] < at; });
  const auto below = static_cast<size_t>(above - sample.begin());
  const uint32_t first = split(sample.first(below), limit);
  const uint32_t second = split(sample.subspan(below), limit);
  splits_[index] = {axis, at, first, second};
  return index;
}

uint32_t Buckets::bucket_of(const glm::ivec3& point) const {
  const Split* split = splits_.data();
  while (split->axis >= 0) split = &splits_[point[split->axis] < split->at ? split->first : split->second];
  return split->first;
}

/// Each triangle goes to the bucket of its centre. A point belongs to the bucket that its place is in. Where
/// another bucket uses it, both know that it is shared: the other one by the point's place, its own one by an
/// entry in foreign_.
void Buckets::distribute(const Read& read) {
  std::vector<std::vector<std::byte>> waiting(places_.size());
  foreign_.resize(places_.size());
  std::vector<size_t> crowded(places_.size(), 1024);
  const auto flush = [&](size_t bucket) {
    if (waiting[bucket].empty()) return;
    places_[bucket].push_back(spool_.append(waiting[bucket]));
    waiting[bucket].clear();
  };
  read(1, [&](std::span<const LatticeTriangle> batch) {
    for (const LatticeTriangle& triangle : batch) {
      const uint32_t bucket = bucket_of(center_of(triangle));
      const auto bytes = std::as_bytes(std::span(&triangle, 1)).first(triangle_bytes_);
      waiting[bucket].insert(waiting[bucket].end(), bytes.begin(), bytes.end());
      if (waiting[bucket].size() >= buffered_triangles * triangle_bytes_) flush(bucket);
      for (const glm::ivec3& corner : triangle.corners) {
        const uint32_t home = bucket_of(corner);
        if (home == bucket) continue;
        foreign_[home].push_back(corner);
        if (foreign_[home].size() < crowded[home]) continue;
        sort_unique(foreign_[home]);
        crowded[home] = std::max<size_t>(1024, foreign_[home].size() * 2);
      }
    }
  });
  uint32_t next = 0;
  for (size_t bucket = 0; bucket < places_.size(); ++bucket) {
    flush(bucket);
    waiting[bucket] = {};
    sort_unique(foreign_[bucket]);
    foreign_[bucket].shrink_to_fit();
    first_number_.push_back(next);
    next += static_cast<uint32_t>(foreign_[bucket].size());
  }
  first_number_.push_back(next);
}

uint32_t Buckets::number_of(const glm::ivec3& point) const {
  const uint32_t home = bucket_of(point);
  const auto& listed = foreign_[home];
  const auto found = std::lower_bound(listed.begin(), listed.end(), point, before);
  return first_number_[home] + static_cast<uint32_t>(found - listed.begin());
}

uint64_t Buckets::triangles(size_t bucket) const {
  uint64_t bytes = 0;
  for (const SpoolPlace& place : places_[bucket]) bytes += place.size;
  return bytes / triangle_bytes_;
}

Bucket Buckets::load(size_t bucket) const {
  Bucket result;
  result.triangles.resize(triangles(bucket));
  auto next = result.triangles.begin();
  for (const SpoolPlace& place : places_[bucket]) {
    const std::vector<std::byte> bytes = spool_.read(place);
    for (size_t at = 0; at < bytes.size(); at += triangle_bytes_)
      std::memcpy(&*next++, bytes.data() + at, triangle_bytes_);
  }
  std::vector<glm::ivec3> shared = foreign_[bucket];
  for (const LatticeTriangle& triangle : result.triangles) {
    for (const glm::ivec3& corner : triangle.corners) {
      if (bucket_of(corner) != bucket) shared.push_back(corner);
    }
  }
  sort_unique(shared);
  for (const glm::ivec3& point : shared) result.shared.push_back({point, number_of(point)});
  return result;
}

}  // namespace triptych
