#include "preprocess/layers/find_layers.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/larger_boxes.hpp"
#include "preprocess/part_space.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>
#include <tsl/robin_set.h>

namespace triptych {

namespace {

using FlatTriangle = std::array<glm::dvec2, 3>;

constexpr double about_parallel = 0.999;  ///< cosine

/// A placed part and its facets.
struct Placed : PartSpace {
  Placed(const Parts& parts, const PlacedParts& hierarchy, uint32_t index, PartCache<PartFacets>& cache)
      : PartSpace(hierarchy, index),
        part(hierarchy.placed[index].part),
        instance(hierarchy.placed[index].instance),
        rounding(PartFacets::flat_steps * parts.lattices[parts.parts[part].lattice].step *
                 hierarchy.stretches[hierarchy.placed[index].transform]),
        facets(cache.get(part)) {}

  uint32_t part, instance;
  double rounding;  ///< what a facet's points may be off its plane
  std::shared_ptr<const PartFacets> facets;
};

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Whether a side of `a` separates the triangles, or leaves an overlap of at most `margin`.
bool separates(const FlatTriangle& a, const FlatTriangle& b, double margin) {
  const double turn = cross(a[1] - a[0], a[2] - a[0]) < 0 ? -1 : 1;
  for (size_t k = 0; k < 3; ++k) {
    const glm::dvec2 side = a[(k + 1) % 3] - a[k];
    const double length = std::hypot(side.x, side.y);
    double deepest = -1;
    for (const glm::dvec2& corner : b) deepest = std::max(deepest, turn * cross(side, corner - a[k]));
    if (deepest <= margin * length) return true;
  }
  return false;
}

/// The plane that facets are compared in: two axes.
struct PlaneAxes {
  explicit PlaneAxes(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const glm::dvec3 least = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                             : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                  : glm::dvec3(0, 0, 1);
    u = glm::normalize(glm::cross(normal, least));
    v = glm::cross(normal, u);
  }
  FlatTriangle of(const Placed& placed, const std::array<uint32_t, 3>& triangle) const {
    FlatTriangle flat;
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3 at = placed.out(placed.facets->points[triangle[k]]);
      flat[k] = {glm::dot(at, u), glm::dot(at, v)};
    }
    return flat;
  }
  glm::dvec3 u, v;
};

bool lies_in_plane(const Placed& of, const Facet& facet, const glm::dvec3& point, const glm::dvec3& normal,
                   double tolerance) {
  for (uint32_t i = facet.first; i < facet.first + facet.count; ++i) {
    for (const uint32_t corner : of.facets->triangles[i]) {
      if (std::abs(glm::dot(of.out(of.facets->points[corner]) - point, normal)) > tolerance) return false;
    }
  }
  return true;
}

/// The facets' triangles, those that reach into `both`.
std::vector<FlatTriangle> flat_triangles(const Placed& of, const Facet& facet, const PlaneAxes& axes,
                                         const Box& both) {
  std::vector<FlatTriangle> triangles;
  for (uint32_t i = facet.first; i < facet.first + facet.count; ++i) {
    Box box;
    for (const uint32_t corner : of.facets->triangles[i]) box.extend(of.out(of.facets->points[corner]));
    if (overlap(box, both)) triangles.push_back(axes.of(of, of.facets->triangles[i]));
  }
  return triangles;
}

bool facets_overlap(const Placed& a, const Facet& of_a, const Placed& b, const Facet& of_b,
                    double tolerance) {
  const glm::dvec3 normal_a = a.normal_out(of_a.normal), normal_b = b.normal_out(of_b.normal);
  const double cosine = glm::dot(normal_a, normal_b);
  if (std::abs(cosine) < about_parallel || (cosine < 0 && of_a.is_outward && of_b.is_outward)) return false;
  const double flat = tolerance + a.rounding + b.rounding;
  const bool a_is_larger = of_a.area > of_b.area;
  const bool same_plane = a_is_larger ? lies_in_plane(b, of_b, a.out(of_a.point), normal_a, flat)
                                      : lies_in_plane(a, of_a, b.out(of_b.point), normal_b, flat);
  if (!same_plane) return false;
  const Box box_a = grown(a.out(of_a.box), tolerance), box_b = grown(b.out(of_b.box), tolerance);
  const Box both{glm::max(box_a.lo, box_b.lo), glm::min(box_a.hi, box_b.hi)};
  const PlaneAxes axes(a_is_larger ? normal_a : normal_b);
  const std::vector<FlatTriangle> in_a = flat_triangles(a, of_a, axes, both),
                                  in_b = flat_triangles(b, of_b, axes, both);
  return std::any_of(in_a.begin(), in_a.end(), [&](const FlatTriangle& first) {
    return std::any_of(in_b.begin(), in_b.end(), [&](const FlatTriangle& second) {
      return !separates(first, second, tolerance) && !separates(second, first, tolerance);
    });
  });
}

/// An overlap that a group of placed parts has with larger ones, or one of them with itself.
struct FoundOverlap {
  uint32_t member = 0;         ///< index in the group
  uint32_t neighbour = no_id;  ///< index among those that the member was compared with; no_id: itself
  uint32_t facet_a = 0, facet_b = 0;
  double span_a = 0, area_a = 0, span_b = 0, area_b = 0;
};

class LayerFinder {
 public:
  LayerFinder(const Parts& parts, const PlacedParts& hierarchy, PartCache<PartFacets>& cache,
              const PlacedCache& kept)
      : parts_(parts),
        hierarchy_(hierarchy),
        cache_(cache),
        kept_(kept),
        tolerance_(contact_steps * parts.lattices[hierarchy.lattice].step),
        boxes_(boxes_of(parts, hierarchy, tolerance_)),
        larger_boxes_(boxes_) {
    uint32_t instances = 0;
    for (const PlacedPart& placed : hierarchy.placed) instances = std::max(instances, placed.instance + 1);
    members_.resize(instances);
    tsl::robin_set<uint32_t> seen;
    for (size_t i = 0; i < hierarchy.placed.size(); ++i) {
      members_[hierarchy.placed[i].instance].push_back(static_cast<uint32_t>(i));
      is_first_.push_back(seen.insert(hierarchy.placed[i].part).second);
    }
  }

  std::vector<FacetOverlap> run(uint64_t& crowded) {
    constexpr size_t at_once = 64;
    const std::vector<uint32_t> ends = kept_.group_ends(hierarchy_);
    if (kept_.is_used()) name_placed();
    std::atomic<uint64_t> left_out = 0;
    std::vector<FacetOverlap> found;
    for (size_t first = 0; first < ends.size(); first += at_once) {
      std::vector<std::vector<FacetOverlap>> batch(std::min(at_once, ends.size() - first));
      parallel_for(batch.size(), [&](size_t index) {
        const size_t group = first + index;
        batch[index] = look_at(group == 0 ? 0 : ends[group - 1], ends[group], left_out);
      });
      for (const auto& overlaps : batch) found.insert(found.end(), overlaps.begin(), overlaps.end());
    }
    crowded += left_out;
    return found;
  }

 private:
  static std::vector<Box> boxes_of(const Parts& parts, const PlacedParts& hierarchy, double tolerance) {
    const Lattice& lattice = parts.lattices[hierarchy.lattice];
    std::vector<Box> boxes;
    for (const LatticeBox& box : hierarchy.boxes) boxes.push_back(grown(lattice.box(box), tolerance));
    return boxes;
  }

  /// Keys of placed parts, with all that span_of() reads.
  void name_placed() {
    placed_keys_.resize(hierarchy_.placed.size());
    for (const std::vector<uint32_t>& members : members_) {
      ContentKeyWriter instance;
      instance.write(uint64_t{members.size()});
      if (members.size() <= many) {
        for (const uint32_t member : members) kept_.add(instance, hierarchy_, member);
      }
      for (const uint32_t member : members) {
        ContentKeyWriter key;
        kept_.add(key, hierarchy_, member);
        key.write(instance.key());
        placed_keys_[member] = key.key();
      }
    }
  }

  /// What a placed part is compared with: larger ones, ascending, and itself if it has several colours.
  struct Compared {
    std::vector<uint32_t> larger;
    bool itself = false;
    bool is_nothing() const { return larger.empty() && !itself; }
  };
  Compared compared_with(uint32_t number, std::atomic<uint64_t>& left_out) const {
    constexpr size_t most_tried = 1024;
    Compared with;
    with.itself = is_first_[number] && color_of(number) == no_id;
    size_t tried = 0;
    larger_boxes_.visit(number, [&](uint32_t larger) {
      if (tried++ == most_tried) {
        ++left_out;
        return false;
      }
      if (may_differ(number, larger)) with.larger.push_back(larger);
      return true;
    });
    std::sort(with.larger.begin(), with.larger.end());
    return with;
  }

  /// The parts from `first` up to `end`.
  std::vector<FacetOverlap> look_at(uint32_t first, uint32_t end, std::atomic<uint64_t>& left_out) const {
    std::vector<Compared> with;
    for (uint32_t number = first; number < end; ++number) with.push_back(compared_with(number, left_out));
    std::vector<FacetOverlap> overlaps;
    for (const FoundOverlap& found : group(first, with)) {
      const uint32_t a = first + found.member;
      const uint32_t b = found.neighbour == no_id ? a : with.at(found.member).larger.at(found.neighbour);
      overlaps.push_back({describe(a, found.facet_a, found.span_a, found.area_a),
                          describe(b, found.facet_b, found.span_b, found.area_b)});
    }
    return overlaps;
  }

  std::vector<FoundOverlap> group(uint32_t first, const std::vector<Compared>& with) const {
    std::vector<FoundOverlap> found;
    const bool is_any = std::any_of(with.begin(), with.end(), [](auto& own) { return !own.is_nothing(); });
    if (is_any) {
      kept_.with_pairs("layers", hierarchy_, placed_keys_, first, with.size(),
                       [&](KeptPairs& pairs) { look_at_pairs(first, with, pairs, found); });
    }
    return found;
  }

  void look_at_pairs(uint32_t first, const std::vector<Compared>& with, KeptPairs& pairs,
                     std::vector<FoundOverlap>& found) const {
    for (uint32_t i = 0; i < with.size(); ++i) {
      const uint32_t own = first + i;
      const auto add = [&](uint32_t other, uint32_t neighbour, const auto& look) {
        const auto overlaps = pairs.get<FoundOverlap>(placed_keys_, own, other, [&] {
          std::vector<FoundOverlap> made;
          look(made);
          return made;
        });
        for (FoundOverlap overlap : overlaps) {
          overlap.member = i;
          overlap.neighbour = neighbour;
          found.push_back(overlap);
        }
      };
      std::optional<Placed> a;
      const auto own_facets = [&]() -> const Placed& { return a ? *a : a.emplace(placed(own)); };
      if (with[i].itself) add(own, no_id, [&](auto& made) { within(own_facets(), made); });
      for (uint32_t k = 0; k < with[i].larger.size(); ++k) {
        const uint32_t other = with[i].larger[k];
        add(other, k, [&](auto& made) { between(own, own_facets(), other, made); });
      }
    }
  }

  uint32_t color_of(uint32_t placed) const { return parts_.parts[hierarchy_.placed[placed].part].color; }
  bool may_differ(uint32_t a, uint32_t b) const { return color_of(a) == no_id || color_of(a) != color_of(b); }
  Placed placed(uint32_t number) const { return Placed(parts_, hierarchy_, number, cache_); }
  bool is_too_small(const Facet& facet) const {
    constexpr double least_diagonal = 8;  // what is smaller cannot be told from an edge
    return diagonal(facet.box) < least_diagonal * tolerance_;
  }

  PlacedFacet describe(uint32_t placed, uint32_t facet, double span, double area) const {
    const PlacedPart& of = hierarchy_.placed[placed];
    return {of.part, facet, of.instance, span, area};
  }

  double span_of(const Placed& own, const Facet& facet) const {
    const std::vector<uint32_t>& members = members_[own.instance];
    if (members.size() > many) return std::numeric_limits<double>::infinity();
    const glm::dvec3 point = own.out(facet.point), normal = own.normal_out(facet.normal);
    double span = 0;
    for (const uint32_t member : members) {
      const Placed other = placed(member);
      for (const Facet& next : other.facets->facets) {
        if (std::abs(glm::dot(other.normal_out(next.normal), normal)) > about_parallel &&
            std::abs(glm::dot(other.out(next.point) - point, normal)) < tolerance_)
          span += next.area;
      }
    }
    return span;
  }

  void add(const Placed& a, uint32_t of_a, const Placed& b, uint32_t of_b,
           std::vector<FoundOverlap>& found) const {
    const Facet &facet_a = a.facets->facets[of_a], &facet_b = b.facets->facets[of_b];
    if (is_too_small(facet_a) || is_too_small(facet_b)) return;
    if (facets_overlap(a, facet_a, b, facet_b, tolerance_))
      found.push_back(
          {0, no_id, of_a, of_b, span_of(a, facet_a), facet_a.area, span_of(b, facet_b), facet_b.area});
  }

  void between(uint32_t first, const Placed& a, uint32_t second, std::vector<FoundOverlap>& found) const {
    const Box both{glm::max(boxes_[first].lo, boxes_[second].lo),
                   glm::min(boxes_[first].hi, boxes_[second].hi)};
    std::optional<Placed> b;  // most reach into each other's boxes with no facet
    a.facets->tree.visit(a.in(both), [&](uint32_t of_a) {
      const Facet& facet = a.facets->facets[of_a];
      if (is_too_small(facet)) return;
      if (!b) b.emplace(placed(second));
      b->facets->tree.visit(grown(b->in(a.out(facet.box)), tolerance_ * b->shrink), [&](uint32_t of_b) {
        const bool same = a.part == b->part && of_a == of_b;
        const uint32_t color = b->facets->facets[of_b].color;
        if (!same && (color == no_id || color != facet.color)) add(a, of_a, *b, of_b, found);
      });
    });
  }

  /// Of a part that has several colours: between its own facets.
  void within(const Placed& own, std::vector<FoundOverlap>& found) const {
    for (uint32_t facet = 0; facet < own.facets->facets.size(); ++facet) {
      const Facet& of = own.facets->facets[facet];
      own.facets->tree.visit(grown(of.box, tolerance_ * own.shrink), [&](uint32_t other) {
        if (other < facet && own.facets->facets[other].color != of.color) add(own, facet, own, other, found);
      });
    }
  }

  static constexpr size_t many = 64;  ///< parts of an instance: they are not looked at for its span

  const Parts& parts_;
  const PlacedParts& hierarchy_;
  PartCache<PartFacets>& cache_;
  const PlacedCache& kept_;
  double tolerance_;
  std::vector<Box> boxes_;  ///< of placed parts
  LargerBoxes larger_boxes_;
  std::vector<ContentKey> placed_keys_;
  std::vector<bool> is_first_;                  ///< placement of its part
  std::vector<std::vector<uint32_t>> members_;  ///< for each instance its placed parts
};

}  // namespace

std::vector<FacetOverlap> find_layers(const Parts& parts, const PlacedParts& hierarchy,
                                      PartCache<PartFacets>& facets, const PlacedCache& kept,
                                      uint64_t& crowded) {
  return LayerFinder(parts, hierarchy, facets, kept).run(crowded);
}

}  // namespace triptych
