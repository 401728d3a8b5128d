#include "preprocess/contacts/find_contacts.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/part_rims.hpp"
#include "preprocess/larger_boxes.hpp"
#include "preprocess/part_cache.hpp"
#include "preprocess/part_space.hpp"
#include "simplify/triangle_tree.hpp"

#include <algorithm>
#include <atomic>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <utility>

namespace triptych {

namespace {

using RimCache = PartCache<PartRims>;

/// A placed part and its rims.
struct Placed : PartSpace {
  Placed(const PlacedParts& hierarchy, uint32_t index, RimCache& cache)
      : PartSpace(hierarchy, index), rims(cache.get(hierarchy.placed[index].part)) {}

  std::shared_ptr<const PartRims> rims;
};

glm::dvec3 closest_on_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double squared = glm::dot(along, along);
  const double share = squared > 0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0;
  return a + along * share;
}

/// What two placed parts have in contact.
struct Touching {
  std::vector<uint32_t> of_first, of_second;  ///< points, ascending
  Box places;                                 ///< of those that lie on a rim of the other
};

/// Whether the point lies on a side of something thin, whose corners it adds then.
bool touch_side(const Placed& thin, const glm::dvec3& at, const glm::dvec3& local, double tolerance,
                std::vector<uint32_t>& corners) {
  bool touches = false;
  thin.rims->side_tree.visit(grown({local, local}, tolerance * thin.shrink), [&](uint32_t index) {
    const auto& side = thin.rims->sides[index];
    const Corners triangle = {thin.out(thin.rims->points[side[0]]), thin.out(thin.rims->points[side[1]]),
                              thin.out(thin.rims->points[side[2]])};
    if (glm::distance(closest_point(at, triangle), at) > tolerance) return;
    touches = true;
    corners.insert(corners.end(), side.begin(), side.end());
  });
  return touches;
}

/// Adds contacts of a's points with b's rims.
void touch(const Placed& a, const Placed& b, const Box& both, double tolerance, bool sides,
           std::vector<uint32_t>& of_a, std::vector<uint32_t>& of_b, Box& places) {
  a.rims->point_tree.visit(a.in(both), [&](uint32_t point) {
    const glm::dvec3 at = a.out(a.rims->points[point]);
    const glm::dvec3 local = b.in(at);
    bool touches = false;
    b.rims->edge_tree.visit(grown({local, local}, tolerance * b.shrink), [&](uint32_t index) {
      const auto& edge = b.rims->edges[index];
      const glm::dvec3 ends[2] = {b.out(b.rims->points[edge[0]]), b.out(b.rims->points[edge[1]])};
      if (glm::distance(closest_on_segment(at, ends[0], ends[1]), at) > tolerance) return;
      touches = true;
      const bool here[2] = {glm::distance(ends[0], at) <= tolerance, glm::distance(ends[1], at) <= tolerance};
      for (size_t end = 0; end < 2; ++end) {
        if (here[end] || !here[1 - end]) of_b.push_back(edge[end]);
      }
    });
    if (!touches && sides && a.rims->of_no_rod[point]) touches = touch_side(b, at, local, tolerance, of_b);
    if (!touches) return;
    places.extend(at);
    of_a.push_back(point);
  });
}

Touching touching(const Placed& a, const Placed& b, const Box& both, double tolerance, bool sides) {
  Touching found;
  touch(a, b, both, tolerance, sides, found.of_first, found.of_second, found.places);
  touch(b, a, both, tolerance, sides, found.of_second, found.of_first, found.places);
  for (std::vector<uint32_t>* points : {&found.of_first, &found.of_second}) {
    std::sort(points->begin(), points->end());
    points->erase(std::unique(points->begin(), points->end()), points->end());
  }
  return found;
}

/// Sorts them, and makes one of those of a point.
void merge(std::vector<Contact>& contacts) {
  const auto key = [](const Contact& contact) { return std::pair(contact.placed, contact.point); };
  std::sort(contacts.begin(), contacts.end(),
            [&](const Contact& a, const Contact& b) { return key(a) < key(b); });
  size_t kept = 0;
  for (const Contact& contact : contacts) {
    if (kept > 0 && key(contacts[kept - 1]) == key(contact)) {
      contacts[kept - 1].span.extend(contact.span);
    } else {
      contacts[kept++] = contact;
    }
  }
  contacts.resize(kept);
}

/// What a group of placed parts has in contact with larger ones.
struct FoundPair {
  uint32_t member = 0;     ///< index in the group
  uint32_t neighbour = 0;  ///< index among those that the member was compared with
  float reach = 0;
  std::vector<uint32_t> of_member, of_neighbour;  ///< points
};
struct GroupContacts {
  std::vector<FoundPair> pairs;
  uint64_t crowded = 0;
};

}  // namespace

template <>
inline constexpr auto record_members<FoundPair> = std::tuple(&FoundPair::reach, &FoundPair::of_member,
                                                             &FoundPair::of_neighbour);

namespace {

class ContactFinder {
 public:
  ContactFinder(const Parts& parts, const PlacedParts& hierarchy, const SpoolFile& geometry, uint64_t memory,
                const PlacedCache& kept)
      : hierarchy_(hierarchy),
        lattice_(parts.lattices[hierarchy.lattice]),
        tolerance_(contact_steps * lattice_.step),
        kept_(kept),
        boxes_(boxes_of(hierarchy, lattice_, tolerance_)),
        larger_boxes_(boxes_),
        cache_(parts, geometry, memory) {
    for (uint32_t i = 0; kept.is_used() && i < hierarchy.placed.size(); ++i)
      placed_keys_.push_back(kept.key_of(hierarchy, i));
  }

  /// Of the parts from `first` up to `end`.
  std::vector<Contact> look_at(uint32_t first, uint32_t end, const std::vector<uint32_t>& places,
                               std::atomic<uint64_t>& crowded) {
    std::vector<std::vector<uint32_t>> larger;
    for (uint32_t number = first; number < end; ++number) larger.push_back(larger_than(number));
    const auto found = group(first, larger);
    crowded += found.crowded;
    std::vector<Contact> contacts;
    for (const FoundPair& pair : found.pairs) {
      const uint32_t number = first + pair.member, other = larger.at(pair.member).at(pair.neighbour);
      for (const uint32_t point : pair.of_member)
        contacts.push_back({number, point, {places[other], places[other], pair.reach}});
      for (const uint32_t point : pair.of_neighbour)
        contacts.push_back({other, point, {places[number], places[number], pair.reach}});
    }
    merge(contacts);
    return contacts;
  }

 private:
  static constexpr size_t most_touched = 32, most_tried = 1024;
  /// Rods and panels whose sizes differ by more than this factor are not looked at for sides.
  static constexpr double most_larger = 4;

  static std::vector<Box> boxes_of(const PlacedParts& hierarchy, const Lattice& lattice, double tolerance) {
    std::vector<Box> boxes;
    for (const LatticeBox& box : hierarchy.boxes) boxes.push_back(grown(lattice.box(box), tolerance));
    return boxes;
  }

  /// The larger parts of other instances that this one may touch, ascending; one more than are tried where
  /// there are more.
  std::vector<uint32_t> larger_than(uint32_t number) const {
    // Of what is smaller the tolerance cannot tell which points touch.
    constexpr double least_diagonal = 8;
    std::vector<uint32_t> found;
    if (diagonal(lattice_.box(hierarchy_.boxes[number])) < least_diagonal * tolerance_) return found;
    larger_boxes_.visit(number, [&](uint32_t larger) {
      if (hierarchy_.placed[larger].instance != hierarchy_.placed[number].instance) found.push_back(larger);
      return found.size() <= most_tried;
    });
    std::sort(found.begin(), found.end());
    return found;
  }

  GroupContacts group(uint32_t first, const std::vector<std::vector<uint32_t>>& larger) {
    GroupContacts result;
    const auto look = [&](KeptPairs& pairs) {
      for (uint32_t i = 0; i < larger.size(); ++i) compare(first + i, i, larger[i], pairs, result);
    };
    const bool is_any = std::any_of(larger.begin(), larger.end(), [](auto& own) { return !own.empty(); });
    if (is_any) kept_.with_pairs("contacts", hierarchy_, placed_keys_, first, larger.size(), look);
    return result;
  }

  void compare(uint32_t number, uint32_t member, const std::vector<uint32_t>& larger, KeptPairs& pairs,
               GroupContacts& found) {
    std::optional<Placed> own;
    size_t touched = 0;
    for (uint32_t i = 0; i < larger.size(); ++i) {
      if (touched == most_touched || i == most_tried) {
        ++found.crowded;
        return;
      }
      const uint32_t other = larger[i];
      auto touch = pairs.get<FoundPair>(placed_keys_, number, other, [&] {
        if (!own) own.emplace(hierarchy_, number, cache_);
        const Box both{glm::max(boxes_[number].lo, boxes_[other].lo),
                       glm::min(boxes_[number].hi, boxes_[other].hi)};
        const bool sides = diagonal(boxes_[other]) <= most_larger * diagonal(boxes_[number]);
        Touching pair = touching(*own, Placed(hierarchy_, other, cache_), both, tolerance_, sides);
        std::vector<FoundPair> made;
        if (pair.of_first.empty() && pair.of_second.empty()) return made;
        const auto reach = static_cast<float>(diagonal(pair.places) / lattice_.step);
        made.push_back({0, 0, reach, std::move(pair.of_first), std::move(pair.of_second)});
        return made;
      });
      if (touch.empty()) continue;
      ++touched;
      touch.front().member = member;
      touch.front().neighbour = i;
      found.pairs.push_back(std::move(touch.front()));
    }
  }

  const PlacedParts& hierarchy_;
  const Lattice& lattice_;
  double tolerance_;
  const PlacedCache& kept_;
  std::vector<ContentKey> placed_keys_;
  std::vector<Box> boxes_;
  LargerBoxes larger_boxes_;
  RimCache cache_;
};

}  // namespace

FoundContacts find_contacts(const Parts& parts, const PlacedParts& hierarchy,
                            const std::vector<uint32_t>& places, const SpoolFile& geometry, uint64_t memory,
                            const PlacedCache& kept) {
  constexpr size_t merged_at_once = 16;
  ContactFinder finder(parts, hierarchy, geometry, memory, kept);
  const std::vector<uint32_t> ends = kept.group_ends(hierarchy);
  FoundContacts found;
  std::atomic<uint64_t> crowded = 0;
  size_t merged = size_t{1} << 16;  // how many contacts there were when they were merged last
  for (size_t first = 0; first < ends.size(); first += merged_at_once) {
    std::vector<std::vector<Contact>> batch(std::min(merged_at_once, ends.size() - first));
    parallel_for(batch.size(), [&](size_t index) {
      const size_t group = first + index;
      batch[index] = finder.look_at(group == 0 ? 0 : ends[group - 1], ends[group], places, crowded);
    });
    for (const auto& contacts : batch)
      found.contacts.insert(found.contacts.end(), contacts.begin(), contacts.end());
    if (found.contacts.size() > 2 * merged) {
      merge(found.contacts);
      merged = std::max(found.contacts.size(), size_t{1} << 16);
    }
  }
  merge(found.contacts);
  found.crowded_parts = crowded;
  return found;
}

}  // namespace triptych
