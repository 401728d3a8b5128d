#include "simplify/star.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace triptych {

bool Star::read(ShrinkingMesh& mesh, uint32_t point) {
  fans_.clear();
  crowd_ = 0;
  if (mesh.degree(point) == 0 || mesh.degree(point) > max_spokes) return false;
  mesh.star(point, spokes_);
  if (!order_single()) order_fans(mesh, point);
  if (mesh.has_colors()) split_at_seams(mesh, point);
  return true;
}

void Star::split_at_seams(const ShrinkingMesh& mesh, uint32_t point) {
  const auto is_seam = [&](size_t before, size_t after) {
    return !mesh.is_textured_across(spokes_[before].triangle, spokes_[after].triangle, point,
                                    spokes_[before].to);
  };
  whole_.swap(fans_);
  fans_.clear();
  for (const auto& [begin, end, closed] : whole_) {
    size_t first = begin;  // behind a seam, in a closed fan that has one
    while (closed && first < end && !is_seam(first == begin ? end - 1 : first - 1, first)) ++first;
    const bool stays_closed = closed && first == end;
    const auto at = [&](size_t spoke) { return spokes_.begin() + static_cast<std::ptrdiff_t>(spoke); };
    if (!stays_closed) std::rotate(at(begin), at(first), at(end));
    size_t from = begin;
    for (size_t next = begin + 1; next < end; ++next) {
      if (stays_closed || !is_seam(next - 1, next)) continue;
      fans_.push_back({from, next, false});
      from = next;
    }
    fans_.push_back({from, end, stays_closed});
  }
}

/// A fast path for the usual case: chains the spokes in place; false, with the spokes in any order, if they
/// are not a single fan of one material, all turned the same way.
bool Star::order_single() {
  const size_t count = spokes_.size();
  size_t chained = 1;
  for (; chained < count; ++chained) {
    const Spoke& last = spokes_[chained - 1];
    size_t next = count;
    for (size_t j = chained; j < count; ++j) {
      if (spokes_[j].from != last.to) continue;
      if (next != count) return false;
      next = j;
    }
    if (next == count) break;
    if (spokes_[next].material != last.material || last.to == spokes_.front().from) return false;
    std::swap(spokes_[chained], spokes_[next]);
  }
  // Each step found exactly one that continues, so no two have the same `from`.
  const bool closed = chained == count && count >= 3 && spokes_.back().to == spokes_.front().from;
  if (!closed && !(chain_before(chained) && corners_differ())) return false;
  fans_.push_back({0, count, closed});
  return true;
}

/// Continues with spokes that come before the first one; the first `chained` are chained already.
bool Star::chain_before(size_t chained) {
  for (; chained < spokes_.size(); ++chained) {
    const auto rest = spokes_.begin() + static_cast<std::ptrdiff_t>(chained);
    const auto before = std::find_if(rest, spokes_.end(), [&](const Spoke& spoke) {
      return spoke.to == spokes_.front().from && spoke.material == spokes_.front().material;
    });
    if (before == spokes_.end()) return false;
    std::rotate(spokes_.begin(), before, before + 1);
  }
  return true;
}

/// Whether no corner of an open fan occurs twice.
bool Star::corners_differ() const {
  for (size_t i = 0; i < spokes_.size(); ++i) {
    for (size_t j = 0; j <= i; ++j) {
      if (spokes_[j].from == spokes_[i].to) return false;
    }
  }
  return true;
}

void Star::order_fans(const ShrinkingMesh& mesh, uint32_t point) {
  join_ends(mesh, point);
  ordered_.clear();
  done_.assign(spokes_.size(), 0);
  for (End end = 0; end < mates_.size(); ++end) {
    if (mates_[end] == none && !done_[end / 2]) follow(end, false);
  }
  for (End end = 0; end < mates_.size(); end += 2) {
    if (!done_[end / 2]) follow(end, true);
  }
  spokes_.swap(ordered_);
}

/// Finds for each end of a spoke the one that it shares an edge with.
void Star::join_ends(const ShrinkingMesh& mesh, uint32_t point) {
  keyed_.clear();
  for (End end = 0; end < 2 * spokes_.size(); ++end) {
    const Spoke& spoke = spokes_[end / 2];
    keyed_.push_back({uint64_t{corner(end)} << 32 | spoke.material, spoke.triangle, end});
  }
  std::sort(keyed_.begin(), keyed_.end(), [](const KeyedEnd& a, const KeyedEnd& b) {
    return a.key != b.key ? a.key < b.key : a.triangle < b.triangle;
  });
  ends_.clear();
  for (const KeyedEnd& keyed : keyed_) ends_.push_back(keyed.end);
  for (size_t i = 2; i < keyed_.size(); ++i) {
    const auto own = static_cast<uint32_t>(keyed_[i].key >> 32);
    crowd_ += own > point && own == keyed_[i - 2].key >> 32;
  }
  mates_.assign(ends_.size(), none);
  for (size_t first = 0, end = 0; first < ends_.size(); first = end) {
    while (end < ends_.size() && keyed_[end].key == keyed_[first].key) ++end;
    if (end - first >= 2) join_flattest(mesh, point, {ends_.data() + first, end - first});
  }
}

/// Joins the flattest pairs of the ends at one edge.
void Star::join_flattest(const ShrinkingMesh& mesh, uint32_t point, std::span<const End> ends) {
  // Two are the usual case; more than a few are a hub of sheets that nothing can order.
  if (ends.size() > 8) return;
  if (ends.size() == 2) {
    if (corner(ends[0] ^ 1) == corner(ends[1] ^ 1)) return;
    mates_[ends[0]] = ends[1];
    mates_[ends[1]] = ends[0];
    return;
  }
  const auto origin = glm::dvec3(mesh.point(point));
  const glm::dvec3 edge = glm::dvec3(mesh.point(corner(ends[0]))) - origin;
  struct Pair {
    double cosine;
    size_t a, b;
  };
  std::array<Pair, 28> pairs;
  size_t count = 0;
  for (size_t a = 0; a < ends.size(); ++a) {
    for (size_t b = a + 1; b < ends.size(); ++b) {
      const uint32_t beyond_a = corner(ends[a] ^ 1), beyond_b = corner(ends[b] ^ 1);
      if (beyond_a == beyond_b) continue;
      const glm::dvec3 normal_a = glm::cross(edge, glm::dvec3(mesh.point(beyond_a)) - origin),
                       normal_b = glm::cross(edge, glm::dvec3(mesh.point(beyond_b)) - origin);
      double cosine = glm::dot(normal_a, normal_b) / (glm::length(normal_a) * glm::length(normal_b));
      // Of sheets that lie on each other, those that are turned the same way belong together.
      if ((ends[a] & 1) == (ends[b] & 1)) cosine += 1e-3;
      pairs[count++] = {cosine, a, b};
    }
  }
  std::sort(pairs.begin(), pairs.begin() + count, [](const Pair& x, const Pair& y) {
    return x.cosine != y.cosine ? x.cosine < y.cosine : x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  for (size_t i = 0; i < count; ++i) {
    const End a = ends[pairs[i].a], b = ends[pairs[i].b];
    if (mates_[a] != none || mates_[b] != none || pairs[i].cosine > 0.5) continue;
    mates_[a] = b;
    mates_[b] = a;
  }
}

/// Puts the fan that begins with this end of a spoke into `ordered_`.
void Star::follow(End end, bool closed) {
  const size_t begin = ordered_.size();
  while (end != none && !done_[end / 2]) {
    done_[end / 2] = 1;
    Spoke spoke = spokes_[end / 2];
    if (end & 1) std::swap(spoke.from, spoke.to);
    ordered_.push_back(spoke);
    end = mates_[end ^ 1];
  }
  fans_.push_back({begin, ordered_.size(), closed});
}

}  // namespace triptych
