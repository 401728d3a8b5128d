#include "preprocess/covered/find_covered.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/covered/relative_place.hpp"
#include "preprocess/covered/surroundings.hpp"
#include "preprocess/spatial_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

namespace triptych {

namespace {

/// Places all over a triangle, inside and near its corners, so that none of it is further than about `apart`
/// from one: in 2 to 8 rows from the corner that its shortest side lies opposite to that side, each as dense
/// as it is wide. False as soon as take(place) is.
template <typename Take>
bool each_sample(const std::array<glm::dvec3, 3>& corners, double apart, const Take& take) {
  constexpr double inset = 0.01;
  size_t top = 0;
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double side = glm::distance(corners[(k + 1) % 3], corners[(k + 2) % 3]);
    longest = std::max(longest, side);
    if (side < shortest) {
      shortest = side;
      top = k;
    }
  }
  const auto steps = [&](double length) { return static_cast<int>(std::ceil(length / apart)); };
  const int rows = std::clamp(steps(longest), 2, 8);
  for (int row = 0; row < rows; ++row) {
    const double down = static_cast<double>(row) / (rows - 1);
    const int places = std::min(row + 1, steps(down * shortest) + 1);
    for (int i = 0; i < places; ++i) {
      const double across = places > 1 ? down * i / (places - 1) : 0;
      const auto share = [](double of) { return inset + (1 - 3 * inset) * of; };
      if (!take(corners[top] * share(1 - down) + corners[(top + 1) % 3] * share(down - across) +
                corners[(top + 2) % 3] * share(across)))
        return false;
    }
  }
  return true;
}

/// What lies over a region in one of the placements: its number in what stands around that, and how near it
/// comes.
struct FoundCover {
  uint64_t neighbour = 0;
  double clearance = 0;
};
/// What was found in some of a part's placements, one after the other.
struct FoundBlock {
  std::vector<uint32_t> left;  ///< regions that are covered in all of them, and in those before
  /// For each placement, and in it for each region that is left.
  std::vector<std::vector<std::vector<FoundCover>>> covers;
};

}  // namespace

template <>
inline constexpr auto record_members<FoundBlock> = std::tuple(&FoundBlock::left, &FoundBlock::covers);

namespace {

class CoveredFinder {
 public:
  CoveredFinder(const Parts& parts, const PlacedParts& hierarchy, PartCache<PartRegions>& cache,
                const PlacedCache& kept)
      : parts_(parts),
        hierarchy_(hierarchy),
        cache_(cache),
        kept_(kept),
        tolerance_(contact_steps * parts.lattices[hierarchy.lattice].step),
        boxes_(boxes_of(parts, hierarchy)),
        tree_(boxes_) {}

  std::vector<CoveredRegion> run() {
    // Part by part: a region that is not covered in one placement is not looked at in others.
    std::map<uint32_t, std::vector<uint32_t>> placements;
    for (uint32_t i = 0; i < hierarchy_.placed.size(); ++i) {
      if (parts_.parts[part_of(i)].outside != Outside::none) placements[part_of(i)].push_back(i);
    }
    std::vector<std::pair<uint32_t, const std::vector<uint32_t>*>> list;
    std::vector<Box> firsts;
    for (const auto& [part, own] : placements) {
      list.push_back({part, &own});
      firsts.push_back(boxes_[own.front()]);
    }
    std::vector<std::vector<CoveredRegion>> found(list.size());
    const std::vector<uint32_t> order = spatial_order(firsts);
    parallel_for(list.size(), [&](size_t i) { found[order[i]] = look_at(*list[order[i]].second); });
    std::vector<CoveredRegion> result;
    for (auto& own : found) {
      for (CoveredRegion& region : own) result.push_back(std::move(region));
    }
    return result;
  }

 private:
  using Covers = std::vector<RegionCover>;

  static std::vector<Box> boxes_of(const Parts& parts, const PlacedParts& hierarchy) {
    std::vector<Box> boxes;
    for (const LatticeBox& box : hierarchy.boxes) boxes.push_back(parts.lattices[hierarchy.lattice].box(box));
    return boxes;
  }
  uint32_t part_of(uint32_t placed) const { return hierarchy_.placed[placed].part; }

  /// What a placement may be covered by, by how it stands to it.
  struct Neighborhood {
    std::vector<std::pair<RelativePlace, uint32_t>> placed;  // ascending

    /// The index in `placed` of what stands there.
    std::optional<size_t> at(const RelativePlace& place) const {
      const auto found =
          std::ranges::lower_bound(placed, place, {}, &std::pair<RelativePlace, uint32_t>::first);
      if (found == placed.end() || found->first != place) return std::nullopt;
      return static_cast<size_t>(found - placed.begin());
    }
    size_t index_of(uint32_t number) const {
      const auto found = std::ranges::find(placed, number, &std::pair<RelativePlace, uint32_t>::second);
      return static_cast<size_t>(found - placed.begin());
    }
  };
  Neighborhood neighborhood(uint32_t number) const {
    const Box box = grown(boxes_[number], diagonal(boxes_[number]) / 16 + tolerance_);
    const PartSpace own(hierarchy_, number);
    Neighborhood result;
    tree_.visit(box, [&](uint32_t other) {
      result.placed.push_back({relative_place(own, hierarchy_, other, tolerance_), other});
    });
    std::sort(result.placed.begin(), result.placed.end());
    return result;
  }

  /// What was found to cover a region in one placement; it does so wherever all of it stands around.
  struct Proof {
    std::vector<std::pair<RelativePlace, double>> covers;  // with clearances
  };
  using Proofs = std::map<uint32_t, std::vector<Proof>>;  // by region

  static std::optional<std::vector<FoundCover>> covers_by(const Proof& proof, const Neighborhood& around) {
    std::vector<FoundCover> covers;
    for (const auto& [place, clearance] : proof.covers) {
      const auto neighbour = around.at(place);
      if (!neighbour) return std::nullopt;
      covers.push_back({*neighbour, clearance});
    }
    return covers;
  }

  /// All placements of one part: the first, then more and more at once, while any region is left.
  std::vector<CoveredRegion> look_at(const std::vector<uint32_t>& placements) const {
    constexpr size_t growth = 4, most = 64;
    std::vector<uint32_t> left;  // set by the first block
    Proofs proofs;
    std::vector<std::vector<std::pair<uint32_t, Covers>>> covers;  // of each placement, by region
    ContentKey before;                                             // of the blocks before
    for (size_t first = 0, size = 1; first < placements.size() && (first == 0 || !left.empty());
         first += size, size = std::min(growth * size, most)) {
      const auto block = std::span(placements).subspan(first, std::min(size, placements.size() - first));
      std::vector<Neighborhood> around;
      for (const uint32_t placed : block) around.push_back(neighborhood(placed));
      const FoundBlock found = find(block, around, first == 0, left, proofs, before);
      left = found.left;
      for (size_t k = 0; k < found.covers.size(); ++k) {
        auto& own = covers.emplace_back();
        for (size_t i = 0; i < left.size(); ++i) {
          Covers over = covers_in(around[k], found.covers[k].at(i));
          note_proof(around[k], found.covers[k][i], proofs[left[i]]);
          own.push_back({left[i], std::move(over)});
        }
      }
    }
    std::vector<CoveredRegion> result;
    for (size_t k = 0; k < placements.size() && !left.empty(); ++k) {
      for (auto& [region, over] : covers.at(k)) {
        if (std::binary_search(left.begin(), left.end(), region))
          result.push_back({placements[k], region, std::move(over)});
      }
    }
    return result;
  }

  /// What find_in() gives, or gave. `before` becomes the key of this block.
  FoundBlock find(std::span<const uint32_t> block, const std::vector<Neighborhood>& around, bool is_first,
                  const std::vector<uint32_t>& left, const Proofs& proofs, ContentKey& before) const {
    const auto make = [&] { return find_in(block, around, is_first, left, proofs); };
    if (!kept_.is_used()) return make();
    ContentKeyWriter key;
    kept_.begin(key, "covered", hierarchy_);
    key.write(before);
    for (size_t k = 0; k < block.size(); ++k) {
      kept_.add(key, hierarchy_, block[k]);
      key.write(uint64_t{around[k].placed.size()});
      for (const auto& [place, other] : around[k].placed) kept_.add(key, hierarchy_, other);
    }
    before = key.key();
    return kept_.get<FoundBlock>(key, make);
  }

  FoundBlock find_in(std::span<const uint32_t> block, const std::vector<Neighborhood>& around, bool is_first,
                     std::vector<uint32_t> left, Proofs proofs) const {
    if (is_first) {
      left.resize(cache_.get(part_of(block.front()))->regions.size());
      std::iota(left.begin(), left.end(), 0u);
    }
    std::vector<std::map<uint32_t, std::vector<FoundCover>>> covers(block.size());
    for (size_t k = 0; k < block.size() && !left.empty(); ++k) {
      Looker looker(*this, block[k], around[k]);
      std::erase_if(left, [&](uint32_t region) {
        auto found = looker.covers_of(region, proofs[region]);
        if (!found) return true;
        note_proof(around[k], *found, proofs[region]);
        covers[k][region] = std::move(*found);
        return false;
      });
    }
    FoundBlock result{left, {}};
    for (size_t k = 0; k < block.size() && !left.empty(); ++k) {
      auto& own = result.covers.emplace_back();
      for (const uint32_t region : left) own.push_back(std::move(covers[k].at(region)));
    }
    return result;
  }

  static Covers covers_in(const Neighborhood& around, const std::vector<FoundCover>& found) {
    Covers covers;
    for (const FoundCover& cover : found)
      covers.push_back({around.placed.at(cover.neighbour).second, cover.clearance});
    std::ranges::sort(covers, {}, &RegionCover::placed);
    return covers;
  }

  /// Adds a way in which a region is covered to its proofs, unless it is there.
  static void note_proof(const Neighborhood& around, const std::vector<FoundCover>& found,
                         std::vector<Proof>& proofs) {
    constexpr size_t most_proofs = 16;
    if (proofs.size() >= most_proofs) return;
    const bool is_known =
        std::ranges::any_of(proofs, [&](const Proof& proof) { return covers_by(proof, around).has_value(); });
    if (is_known) return;
    Proof& proof = proofs.emplace_back();
    for (const FoundCover& cover : found)
      proof.covers.push_back({around.placed.at(cover.neighbour).first, cover.clearance});
  }

  /// A placement among what stands around it, which is loaded where it is needed.
  class Looker {
   public:
    Looker(const CoveredFinder& finder, uint32_t placed, const Neighborhood& around)
        : finder_(finder), number_(placed), around_(around) {}

    /// Nothing where the region is not covered all over.
    std::optional<std::vector<FoundCover>> covers_of(uint32_t region, const std::vector<Proof>& proofs) {
      for (const Proof& proof : proofs) {
        if (auto covers = covers_by(proof, around_)) return covers;
      }
      if (!surroundings_) {
        std::vector<std::pair<uint32_t, Box>> others;
        for (const auto& [place, other] : around_.placed) others.push_back({other, finder_.boxes_[other]});
        surroundings_.emplace(finder_.parts_, finder_.hierarchy_, finder_.cache_, number_, others,
                              finder_.tolerance_);
      }
      const auto covers = finder_.look_over(*surroundings_, region);
      if (!covers) return std::nullopt;
      std::vector<FoundCover> found;
      for (const RegionCover& cover : *covers)
        found.push_back({around_.index_of(cover.placed), cover.clearance});
      return found;
    }

   private:
    const CoveredFinder& finder_;
    uint32_t number_;
    const Neighborhood& around_;
    std::optional<Surroundings> surroundings_;
  };

  /// Samples a region all over; nothing where it is not covered.
  std::optional<Covers> look_over(Surroundings& surroundings, uint32_t index) const {
    const PlacedRegions& own = surroundings.own();
    const SmoothRegion& region = own.regions->regions[index];
    const double size = diagonal(own.out(region.box));
    if (size < 8 * tolerance_) return std::nullopt;
    // How large the surface is of which a border cut off a corner is not known: it may lie deeper than the
    // corner alone might, where it is hidden from the sides, too.
    const double least = region.is_cut ? own.regions->diagonal / own.shrink / 4 : 0;
    const bool is_corner = size < least;
    const double whole = std::max(size, least);
    const double apart = size / 12;
    std::map<uint32_t, double> nearest;
    for (uint32_t i = region.first; i < region.first + region.count; ++i) {
      const auto corners = own.corners(i);
      glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
      const double length = glm::length(normal);
      if (!(length > 0)) continue;
      normal *= (own.turns_over ? -1 : 1) / length;
      const bool all = each_sample(corners, apart, [&](const glm::dvec3& at) {
        const auto over = surroundings.over(index, at, normal, whole);
        if (!over) return false;
        const auto [entry, inserted] = nearest.try_emplace(over->placed, over->clearance);
        if (!inserted) entry->second = std::min(entry->second, over->clearance);
        return !is_corner || surroundings.hidden_from_sides(index, at, normal, whole);
      });
      if (!all) return std::nullopt;
    }
    Covers covers;
    for (const auto& [placed, clearance] : nearest) covers.push_back({placed, clearance});
    return covers;
  }

  const Parts& parts_;
  const PlacedParts& hierarchy_;
  PartCache<PartRegions>& cache_;
  const PlacedCache& kept_;
  double tolerance_;
  std::vector<Box> boxes_;  ///< of placed parts
  BoxTree tree_;
};

}  // namespace

std::vector<CoveredRegion> find_covered(const Parts& parts, const PlacedParts& hierarchy,
                                        PartCache<PartRegions>& regions, const PlacedCache& kept) {
  return CoveredFinder(parts, hierarchy, regions, kept).run();
}

}  // namespace triptych
