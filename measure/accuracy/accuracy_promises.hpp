// What a build promises of pictures beside distances, by the words of its --keep, and whether that was kept.
#pragma once

#include "measure/accuracy/accuracy.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// Patches of pixels of which the pictures of a pack have fewer than so many.
struct PatchPromise {
  const char* what;                ///< "holes"
  const char* where;               ///< which of them, in words; may be empty
  std::vector<const char*> words;  ///< of --keep: the promise is given where the build kept all of them
  const char* crowded;             ///< what the build says where it could not look at everything
  double limit;                    ///< pixels a million of surface: fewer than that; 0: none
  uint64_t PictureTally::*pixels;
  WorstPatch PictureTally::*worst;

  /// "--keep touching"
  std::string keep() const;
  /// "no holes", "fewer than 20 pixels of swaps a million away from edges"
  std::string in_words() const;
};

/// All that there are: a further one is a further row here.
std::span<const PatchPromise> patch_promises();

/// Whether the row's pack promises it, and its strategy draws what the pack gives.
bool is_promised(const PatchPromise& promise, const AccuracyRow& row);
/// Why not, of a row that does not promise it: "built without --keep touching".
std::string why_not_promised(const PatchPromise& promise, const AccuracyRow& row);
/// Whether its pictures have as many or more.
bool is_broken(const PatchPromise& promise, const AccuracyRow& row);

/// Appends what was promised and is broken, each once for all rows that share their pictures.
void find_broken_promises(AccuracyResult& result);

}  // namespace triptych
