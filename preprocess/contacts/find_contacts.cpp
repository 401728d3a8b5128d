#include "preprocess/contacts/find_contacts.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/part_rims.hpp"
#include "preprocess/larger_boxes.hpp"
#include "preprocess/part_cache.hpp"
#include "preprocess/part_space.hpp"

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

/// Adds contacts of a's points with b's rims.
void touch(const Placed& a, const Placed& b, const Box& both, double tolerance, std::vector<uint32_t>& of_a,
           std::vector<uint32_t>& of_b, Box& places) {
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
    if (!touches) return;
    places.extend(at);
    of_a.push_back(point);
  });
}

Touching touching(const Placed& a, const Placed& b, const Box& both, double tolerance) {
  Touching found;
  touch(a, b, both, tolerance, found.of_first, found.of_second, found.places);
  touch(b, a, both, tolerance, found.of_second, found.of_first, found.places);
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

}  // namespace

FoundContacts find_contacts(const Parts& parts, const PlacedParts& hierarchy,
                            const std::vector<uint32_t>& places, const SpoolFile& geometry, uint64_t memory) {
  constexpr size_t most_touched = 32, most_tried = 1024, merged_at_once = 256;
  // Of what is smaller the tolerance cannot tell which points touch.
  constexpr double least_diagonal = 8;
  const Lattice& lattice = parts.lattices[hierarchy.lattice];
  const double tolerance = contact_steps * lattice.step;
  std::vector<Box> boxes;
  for (const LatticeBox& box : hierarchy.boxes) boxes.push_back(grown(lattice.box(box), tolerance));
  const LargerBoxes larger_boxes(boxes);
  RimCache cache(parts, geometry, memory);
  FoundContacts found;
  std::atomic<uint64_t> crowded = 0;
  size_t merged = size_t{1} << 16;  // how many contacts there were when they were merged last
  for (size_t first = 0; first < boxes.size(); first += merged_at_once) {
    std::vector<std::vector<Contact>> batch(std::min(merged_at_once, boxes.size() - first));
    parallel_for(batch.size(), [&](size_t index) {
      const auto number = static_cast<uint32_t>(first + index);
      if (diagonal(lattice.box(hierarchy.boxes[number])) < least_diagonal * tolerance) return;
      std::optional<Placed> own;
      size_t touched = 0, tried = 0;
      larger_boxes.visit(number, [&](uint32_t larger) {
        if (hierarchy.placed[larger].instance == hierarchy.placed[number].instance) return true;
        if (touched == most_touched || tried++ == most_tried) {
          ++crowded;
          return false;
        }
        if (!own) own.emplace(hierarchy, number, cache);
        const Box both{glm::max(boxes[number].lo, boxes[larger].lo),
                       glm::min(boxes[number].hi, boxes[larger].hi)};
        const Touching pair = touching(*own, Placed(hierarchy, larger, cache), both, tolerance);
        if (pair.of_first.empty() && pair.of_second.empty()) return true;
        ++touched;
        const auto reach = static_cast<float>(diagonal(pair.places) / lattice.step);
        for (const uint32_t point : pair.of_first)
          batch[index].push_back({number, point, {places[larger], places[larger], reach}});
        for (const uint32_t point : pair.of_second)
          batch[index].push_back({larger, point, {places[number], places[number], reach}});
        return true;
      });
      merge(batch[index]);
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
