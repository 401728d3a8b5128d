#include "preprocess/covered/find_covered.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/covered/look_over.hpp"
#include "preprocess/covered/relative_place.hpp"
#include "preprocess/spatial_order.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

namespace triptych {

namespace {

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

/// What a build keeps of a block.
struct KeptBlock {
  ContentKey key;  ///< of all that `found` was made of
  FoundBlock found;
  std::vector<std::byte> regions;  ///< KeptPairs::bytes() of regions, each in one placement
};

}  // namespace

template <>
inline constexpr auto record_members<KeptBlock> = std::tuple(&KeptBlock::key, &KeptBlock::found,
                                                             &KeptBlock::regions);

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
        tree_(boxes_) {
    for (uint32_t i = 0; kept.is_used() && i < hierarchy.placed.size(); ++i)
      placed_keys_.push_back(kept.key_of(hierarchy, i));
  }

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

  /// Where blocks of a part's placements end, ascending: the first is alone, since what is open there need
  /// not be looked at elsewhere; then of about 16, at most 64, so that where the placements change in one
  /// place the other blocks stay the same.
  std::vector<size_t> block_ends(const std::vector<uint32_t>& placements) const {
    constexpr size_t about = 16, most = 64;
    std::vector<size_t> ends = {1};
    for (size_t i = 1; i < placements.size(); ++i) {
      const size_t size = i + 1 - ends.back();
      const bool ends_here = kept_.is_used() ? placed_keys_[placements[i]].low % about == 0 : size == about;
      if (ends_here || size == most || i + 1 == placements.size()) ends.push_back(i + 1);
    }
    return ends;
  }

  /// All placements of one part, block by block while any region is left.
  std::vector<CoveredRegion> look_at(const std::vector<uint32_t>& placements) const {
    std::vector<uint32_t> left;  // set by the first block
    Proofs proofs;
    std::vector<std::vector<std::pair<uint32_t, Covers>>> covers;  // of each placement, by region
    ContentKey before;                                             // of the blocks before
    size_t first = 0;
    for (const size_t end : block_ends(placements)) {
      if (first > 0 && left.empty()) break;
      const auto block = std::span(placements).subspan(first, end - first);
      std::vector<Neighborhood> around;
      for (const uint32_t placed : block) around.push_back(neighborhood(placed));
      const FoundBlock found = find(block, around, first == 0, left, proofs, before);
      first = end;
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
    if (!kept_.is_used()) {
      KeptPairs none;
      return find_in(block, around, is_first, left, proofs, none);
    }
    constexpr std::string_view what = "covered";
    ContentKeyWriter own, all;
    kept_.begin(own, what, hierarchy_);
    all.write(before);
    for (size_t k = 0; k < block.size(); ++k) {
      own.write(placed_keys_[block[k]]);
      all.write(uint64_t{around[k].placed.size()});
      for (const auto& [place, other] : around[k].placed) all.write(placed_keys_[other]);
    }
    all.write(own.key());
    before = all.key();
    FoundBlock found;
    kept_.renew(what, own, [&](const std::vector<std::byte>& bytes) {
      KeptBlock known;
      if (!bytes.empty()) known = record_of<KeptBlock>(bytes, "a build's cache");
      if (known.key == before) {
        found = std::move(known.found);
        return bytes;
      }
      KeptPairs regions(known.regions);
      found = find_in(block, around, is_first, left, proofs, regions);
      return record_bytes(KeptBlock{before, found, regions.bytes()});
    });
    return found;
  }

  FoundBlock find_in(std::span<const uint32_t> block, const std::vector<Neighborhood>& around, bool is_first,
                     std::vector<uint32_t> left, Proofs proofs, KeptPairs& regions) const {
    if (is_first) {
      left.resize(cache_.get(part_of(block.front()))->regions.size());
      std::iota(left.begin(), left.end(), 0u);
    }
    std::vector<std::map<uint32_t, std::vector<FoundCover>>> covers(block.size());
    for (size_t k = 0; k < block.size() && !left.empty(); ++k) {
      Looker looker(*this, block[k], around[k], regions);
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
    Looker(const CoveredFinder& finder, uint32_t placed, const Neighborhood& around, KeptPairs& regions)
        : finder_(finder), number_(placed), around_(around), kept_(regions) {}

    /// Nothing where the region is not covered all over.
    std::optional<std::vector<FoundCover>> covers_of(uint32_t region, const std::vector<Proof>& proofs) {
      for (const Proof& proof : proofs) {
        if (auto covers = covers_by(proof, around_)) return covers;
      }
      return kept_.is_used() ? kept_covers(region) : covers_of(region);
    }

   private:
    /// What covers_of() gives, or gave: its neighbours among those alone that may lie over the region, so
    /// that others may come and go.
    std::optional<std::vector<FoundCover>> kept_covers(uint32_t region) {
      ContentKeyWriter key;
      key.write(finder_.placed_keys_[number_]);
      key.write(region);
      std::vector<uint64_t> near;  // indices in what stands around
      size_t at = 0;
      for (const uint32_t other : reached_from(surroundings(), region, finder_.tolerance_)) {
        while (around_.placed[at].second != other) ++at;
        near.push_back(at);
        key.write(finder_.placed_keys_[other]);
        key.write(other == number_);
      }
      const auto found = kept_.get<std::vector<FoundCover>>(key.key(), [&] {
        std::vector<std::vector<FoundCover>> made;
        auto covers = covers_of(region);
        if (!covers) return made;
        for (FoundCover& cover : *covers) {
          const auto index = std::ranges::lower_bound(near, cover.neighbour);
          cover.neighbour = static_cast<uint64_t>(index - near.begin());
        }
        made.push_back(std::move(*covers));
        return made;
      });
      if (found.empty()) return std::nullopt;
      std::vector<FoundCover> covers = found.front();
      for (FoundCover& cover : covers) cover.neighbour = near.at(cover.neighbour);
      return covers;
    }

    Surroundings& surroundings() {
      if (surroundings_) return *surroundings_;
      std::vector<std::pair<uint32_t, Box>> others;
      for (const auto& [place, other] : around_.placed) others.push_back({other, finder_.boxes_[other]});
      return surroundings_.emplace(finder_.parts_, finder_.hierarchy_, finder_.cache_, number_, others,
                                   finder_.tolerance_);
    }

    std::optional<std::vector<FoundCover>> covers_of(uint32_t region) {
      const auto covers = look_over(surroundings(), region, finder_.tolerance_);
      if (!covers) return std::nullopt;
      std::vector<FoundCover> found;
      for (const RegionCover& cover : *covers)
        found.push_back({around_.index_of(cover.placed), cover.clearance});
      return found;
    }

    const CoveredFinder& finder_;
    uint32_t number_;
    const Neighborhood& around_;
    KeptPairs& kept_;
    std::optional<Surroundings> surroundings_;
  };

  const Parts& parts_;
  const PlacedParts& hierarchy_;
  PartCache<PartRegions>& cache_;
  const PlacedCache& kept_;
  double tolerance_;
  std::vector<Box> boxes_;  ///< of placed parts
  BoxTree tree_;
  std::vector<ContentKey> placed_keys_;  ///< empty where there is no cache
};

}  // namespace

std::vector<CoveredRegion> find_covered(const Parts& parts, const PlacedParts& hierarchy,
                                        PartCache<PartRegions>& regions, const PlacedCache& kept) {
  return CoveredFinder(parts, hierarchy, regions, kept).run();
}

}  // namespace triptych
