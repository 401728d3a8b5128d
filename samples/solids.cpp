#include "samples/solids.hpp"

#include <algorithm>
#include <map>

namespace triptych {
namespace {

std::vector<double> breaks(double low, double high, const std::vector<Rect>& holes, bool second) {
  std::vector<double> result{low, high};
  for (const Rect& hole : holes)
    for (const double at : {second ? hole.z0 : hole.x0, second ? hole.z1 : hole.x1})
      if (at > low && at < high) result.push_back(at);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Cells of the slab between breaks; faces where solid meets empty.
class Slab {
 public:
  Slab(const glm::dvec3& low, const glm::dvec3& high, int axis, const std::vector<Rect>& holes)
      : low_(low), high_(high), axis_(axis), u_(axis == 0 ? 2 : 0), v_(axis == 1 ? 2 : 1) {
    us_ = breaks(low[u_], high[u_], holes, false);
    vs_ = breaks(low[v_], high[v_], holes, true);
    solid_.assign((us_.size() - 1) * (vs_.size() - 1), true);
    for (size_t i = 0; i + 1 < us_.size(); ++i)
      for (size_t j = 0; j + 1 < vs_.size(); ++j)
        for (const Rect& hole : holes)
          if (us_[i] >= hole.x0 && us_[i + 1] <= hole.x1 && vs_[j] >= hole.z0 && vs_[j + 1] <= hole.z1)
            solid_[i * (vs_.size() - 1) + j] = false;
  }

  MeshPart mesh() {
    for (size_t i = 0; i + 1 < us_.size(); ++i) {
      for (size_t j = 0; j + 1 < vs_.size(); ++j) {
        if (!solid(i, j)) continue;
        face({i, j, 0}, {i, j + 1, 0}, {i + 1, j + 1, 0}, {i + 1, j, 0});
        face({i, j, 1}, {i + 1, j, 1}, {i + 1, j + 1, 1}, {i, j + 1, 1});
        if (!solid(i - 1, j)) face({i, j, 0}, {i, j, 1}, {i, j + 1, 1}, {i, j + 1, 0});
        if (!solid(i + 1, j)) face({i + 1, j, 0}, {i + 1, j + 1, 0}, {i + 1, j + 1, 1}, {i + 1, j, 1});
        if (!solid(i, j - 1)) face({i, j, 0}, {i + 1, j, 0}, {i + 1, j, 1}, {i, j, 1});
        if (!solid(i, j + 1)) face({i, j + 1, 0}, {i, j + 1, 1}, {i + 1, j + 1, 1}, {i + 1, j + 1, 0});
      }
    }
    return std::move(part_);
  }

 private:
  struct Corner {
    size_t i, j;
    int side;
    bool operator<(const Corner& other) const {
      return std::tie(i, j, side) < std::tie(other.i, other.j, other.side);
    }
  };

  // Indices below zero wrap around to large ones, which are outside too.
  bool solid(size_t i, size_t j) const {
    return i < us_.size() - 1 && j < vs_.size() - 1 && solid_[i * (vs_.size() - 1) + j];
  }

  uint32_t number(const Corner& corner) {
    const auto [found, added] = numbers_.try_emplace(corner, static_cast<uint32_t>(part_.positions.size()));
    if (added) {
      glm::dvec3 position;
      position[u_] = us_[corner.i];
      position[v_] = vs_[corner.j];
      position[axis_] = corner.side ? high_[axis_] : low_[axis_];
      part_.positions.emplace_back(position);
    }
    return found->second;
  }

  void face(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    const uint32_t n[] = {number(a), number(b), number(c), number(d)};
    // u, v, axis are right-handed for z through x, y; the other two orders are left-handed.
    if (axis_ == 2) {
      part_.indices.insert(part_.indices.end(), {n[0], n[1], n[2], n[0], n[2], n[3]});
    } else {
      part_.indices.insert(part_.indices.end(), {n[0], n[2], n[1], n[0], n[3], n[2]});
    }
  }

  glm::dvec3 low_, high_;
  int axis_, u_, v_;
  std::vector<double> us_, vs_;
  std::vector<bool> solid_;
  std::map<Corner, uint32_t> numbers_;
  MeshPart part_;
};

}  // namespace

MeshPart pierced_box(const glm::dvec3& low, const glm::dvec3& high, int axis, const std::vector<Rect>& holes,
                     const glm::dvec3& colour) {
  MeshPart part = Slab(low, high, axis, holes).mesh();
  part.colour = colour;
  return part;
}

MeshPart box(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& colour) {
  return pierced_box(low, high, 1, {}, colour);
}

void append(MeshPart& part, const MeshPart& other) {
  const auto first = static_cast<uint32_t>(part.positions.size());
  part.positions.insert(part.positions.end(), other.positions.begin(), other.positions.end());
  for (const uint32_t index : other.indices) part.indices.push_back(first + index);
}

}  // namespace triptych
