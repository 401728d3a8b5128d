#include "preprocess/contacts/find_contacts.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/part_rims.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace triptych {

namespace {

/// The rims of parts, those that were used last.
class RimCache {
 public:
  RimCache(const Parts& parts, const SpoolFile& geometry, uint64_t bytes)
      : parts_(parts), geometry_(geometry), bytes_left_(static_cast<int64_t>(bytes)) {}

  std::shared_ptr<const PartRims> get(uint32_t part) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = entries_.find(part); found != entries_.end()) {
        recent_.splice(recent_.begin(), recent_, found->second.place);
        return found->second.rims;
      }
    }
    const PartInfo& info = parts_.parts[part];
    const auto rims =
        std::make_shared<const PartRims>(load<Part>(geometry_, info.place), parts_.lattices[info.lattice]);
    const std::lock_guard lock(mutex_);
    if (entries_.count(part) > 0) return rims;
    recent_.push_front(part);
    entries_[part] = {rims, recent_.begin()};
    bytes_left_ -= static_cast<int64_t>(rims->size());
    while (bytes_left_ < 0 && recent_.size() > 1) {
      const auto oldest = entries_.find(recent_.back());
      bytes_left_ += static_cast<int64_t>(oldest->second.rims->size());
      entries_.erase(oldest);
      recent_.pop_back();
    }
    return rims;
  }

 private:
  struct Entry {
    std::shared_ptr<const PartRims> rims;
    std::list<uint32_t>::iterator place;
  };
  const Parts& parts_;
  const SpoolFile& geometry_;
  std::mutex mutex_;
  std::list<uint32_t> recent_;  ///< the last used one first
  std::unordered_map<uint32_t, Entry> entries_;
  int64_t bytes_left_;
};

/// A placed part and what leads back to its own space.
struct Placed {
  Placed(const PlacedParts& hierarchy, uint32_t index, RimCache& cache)
      : number(index),
        rims(cache.get(hierarchy.placed[index].part)),
        transform(hierarchy.transforms[hierarchy.placed[index].transform]),
        inverse(glm::inverse(glm::dmat3(transform))),
        shrink(0) {
    for (int row = 0; row < 3; ++row) {
      const glm::dvec3 entries(inverse[0][row], inverse[1][row], inverse[2][row]);
      shrink = std::max(shrink, glm::length(entries));
    }
  }
  glm::dvec3 out(const glm::dvec3& point) const { return transform * glm::dvec4(point, 1); }
  glm::dvec3 in(const glm::dvec3& point) const { return inverse * (point - transform[3]); }
  /// In its own space a box that holds this one of the hierarchy's space.
  Box in(const Box& box) const {
    Box own;
    for (int corner = 0; corner < 8; ++corner) own.extend(in(box.corner(corner)));
    return own;
  }

  uint32_t number;
  std::shared_ptr<const PartRims> rims;
  Affine transform;
  glm::dmat3 inverse;
  double shrink;  ///< no coordinate of its own space changes by more than this for a step of length 1
};

glm::dvec3 closest_on_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double squared = glm::dot(along, along);
  const double share = squared > 0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0;
  return a + along * share;
}

/// Contacts of a's points with b's rims, without their reach, and the box of those points.
void touch(const Placed& a, const Placed& b, const Box& both, double tolerance,
           std::vector<Contact>& contacts, Box& places) {
  a.rims->point_tree.visit(a.in(both), [&](uint32_t point) {
    const glm::dvec3 at = a.out(a.rims->points[point]);
    const glm::dvec3 local = b.in(at);
    b.rims->edge_tree.visit(grown({local, local}, tolerance * b.shrink), [&](uint32_t index) {
      const auto& edge = b.rims->edges[index];
      const glm::dvec3 ends[2] = {b.out(b.rims->points[edge[0]]), b.out(b.rims->points[edge[1]])};
      if (glm::distance(closest_on_segment(at, ends[0], ends[1]), at) > tolerance) return;
      places.extend(at);
      contacts.push_back({a.number, point, b.number});
      const bool here[2] = {glm::distance(ends[0], at) <= tolerance, glm::distance(ends[1], at) <= tolerance};
      for (size_t end = 0; end < 2; ++end) {
        if (here[end] || !here[1 - end]) contacts.push_back({b.number, edge[end], a.number});
      }
    });
  });
}

std::vector<Contact> contacts_in(const Parts& parts, const PlacedParts& hierarchy, const SpoolFile& geometry,
                                 uint64_t memory) {
  const Lattice& lattice = parts.lattices[hierarchy.lattice];
  const double tolerance = contact_steps * lattice.step;
  std::vector<Box> boxes;
  for (const LatticeBox& box : hierarchy.boxes) boxes.push_back(grown(lattice.box(box), tolerance));
  const BoxTree tree(boxes);
  RimCache cache(parts, geometry, memory);
  std::vector<std::vector<Contact>> found(boxes.size());
  parallel_for(boxes.size(), [&](size_t i) {
    std::vector<uint32_t> others;
    tree.visit(boxes[i], [&](uint32_t other) {
      if (other > i && hierarchy.placed[other].instance != hierarchy.placed[i].instance)
        others.push_back(other);
    });
    if (others.empty()) return;
    const Placed own(hierarchy, static_cast<uint32_t>(i), cache);
    for (const uint32_t number : others) {
      const Placed other(hierarchy, number, cache);
      const Box both{glm::max(boxes[i].lo, boxes[number].lo), glm::min(boxes[i].hi, boxes[number].hi)};
      const size_t first = found[i].size();
      Box places;
      touch(own, other, both, tolerance, found[i], places);
      touch(other, own, both, tolerance, found[i], places);
      for (size_t k = first; k < found[i].size(); ++k)
        found[i][k].reach = static_cast<float>(diagonal(places) / lattice.step);
    }
    std::sort(found[i].begin(), found[i].end());
    found[i].erase(std::unique(found[i].begin(), found[i].end()), found[i].end());
  });
  std::vector<Contact> contacts;
  for (const auto& some : found) contacts.insert(contacts.end(), some.begin(), some.end());
  std::sort(contacts.begin(), contacts.end());
  contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
  return contacts;
}

}  // namespace

std::vector<std::vector<Contact>> find_contacts(const Parts& parts, const SpoolFile& geometry,
                                                uint64_t memory) {
  std::vector<std::vector<Contact>> contacts;
  for (const PlacedParts& hierarchy : parts.hierarchies)
    contacts.push_back(contacts_in(parts, hierarchy, geometry, memory));
  return contacts;
}

}  // namespace triptych
