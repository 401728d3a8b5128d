#include "measure/accuracy/accuracy_promises.hpp"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <fmt/ranges.h>

namespace triptych {

namespace {

double a_million(const PatchPromise& promise, const AccuracyRow& row) {
  return 1e6 * row.pictures->share_of_surface((*row.pictures).*(promise.pixels));
}

bool keeps(const AccuracyRow& row, const char* word) { return has_word(row.build, "keep", word); }

/// Parts that the build said were among so many others that it did not look at all of those.
std::string crowded_parts(const PatchPromise& promise, const AccuracyRow& row) {
  const auto found = row.build.find(promise.crowded);
  return found == row.build.end() ? "" : found->second;
}

}  // namespace

std::span<const PatchPromise> patch_promises() {
  static const std::array promises = {
      PatchPromise{
          "holes", "", {"touching"}, "crowded-parts", 0, &PictureTally::hole_pixels, &PictureTally::hole},
      PatchPromise{"swaps",
                   " away from edges",
                   {"order", "planes"},
                   "crowded-planes",
                   20,
                   &PictureTally::inner_swap_pixels,
                   &PictureTally::inner_swap}};
  return promises;
}

std::string PatchPromise::keep() const { return fmt::format("--keep {}", fmt::join(words, ",")); }

std::string PatchPromise::in_words() const {
  return limit == 0 ? fmt::format("no {}{}", what, where)
                    : fmt::format("fewer than {:g} pixels of {} a million{}", limit, what, where);
}

bool is_promised(const PatchPromise& promise, const AccuracyRow& row) {
  return row.may_miss.empty() && crowded_parts(promise, row).empty() &&
         std::all_of(promise.words.begin(), promise.words.end(),
                     [&](const char* word) { return keeps(row, word); });
}

std::string why_not_promised(const PatchPromise& promise, const AccuracyRow& row) {
  if (!row.may_miss.empty()) return "what this strategy leaves out is no promise of the build";
  if (row.build.empty()) return "the pack does not say how it was built";
  for (const char* word : promise.words) {
    if (!keeps(row, word)) return "built without " + promise.keep();
  }
  return fmt::format("the build did not look at all that {} parts touch or overlap",
                     crowded_parts(promise, row));
}

bool is_broken(const PatchPromise& promise, const AccuracyRow& row) {
  return (*row.pictures).*(promise.pixels) > 0 && a_million(promise, row) >= promise.limit;
}

void find_broken_promises(AccuracyResult& result) {
  std::vector<const PictureTally*> seen;
  for (size_t i = 0; i < result.rows.size(); ++i) {
    const AccuracyRow& row = result.rows[i];
    if (!row.may_miss.empty() || std::count(seen.begin(), seen.end(), row.pictures.get()) > 0) continue;
    seen.push_back(row.pictures.get());
    for (const PatchPromise& promise : patch_promises()) {
      if (!is_promised(promise, row) || !is_broken(promise, row)) continue;
      const WorstPatch& worst = (*row.pictures).*(promise.worst);
      result.violations.push_back(
          {i,
           fmt::format("{} pixels of {}{}, {:.0f} a million, and {} promises {}; the largest patch has {}, "
                       "at {},{} from the lower left",
                       (*row.pictures).*(promise.pixels), promise.what, promise.where,
                       a_million(promise, row), promise.keep(), promise.in_words(), worst.pixels, worst.at.x,
                       worst.at.y),
           worst.frame, worst.at});
    }
  }
}

}  // namespace triptych
