// Whether a pack is sound: its bytes, its boxes, its errors. Distances are measured by a method that shares
// no code with the build, so that a mistake of the build is not repeated.
#pragma once

#include "base/distribution.hpp"
#include "scene/pack.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace triptych {

struct CheckOptions {
  /// Points at which distances are measured, over all drawables; two to three million take a second on two
  /// cores.
  uint64_t points = 60'000'000;
  /// How many violations are put into words.
  size_t messages = 10;
  /// Told those words as soon as there are any, one call at a time; the order may differ from that of the
  /// report.
  std::function<void(const std::string&)> found = {};
};

struct CheckReport {
  /// Drawables whose bound was compared with a measured distance, and those for which that was impossible:
  /// their chunks, or their source's, are damaged.
  uint64_t drawables_checked = 0, drawables_not_checked = 0;
  uint64_t bound_violations = 0;  ///< drawables that are further from their source than their error says
  /// Placements that leave their scene node's box, boxes that leave their parent's.
  uint64_t box_violations = 0;
  /// Errors that shrink along a scene node's drawables or towards the root.
  uint64_t monotonicity_violations = 0;
  /// Chunks with triangles that are said to be outward (Chunk::outward) and are not proven to be.
  uint64_t outward_violations = 0;
  /// Drawables that leave out what others cover (scene/seen_from_outside.hpp) without being marked, or what
  /// nothing covers that is as near to it as their error.
  uint64_t seen_violations = 0;
  uint64_t checksum_errors =
      0;  ///< chunks, and the sections OBJS and OPTS, that do not verify or do not decode
  /// Error over measured distance, of simplified drawables whose measured distance exceeds the lattice's
  /// rounding.
  Distribution bound_over_measured;
  std::vector<std::string> messages;  ///< the first violations, each with its place

  bool sound() const {
    return bound_violations + box_violations + monotonicity_violations + outward_violations +
               seen_violations + checksum_errors ==
           0;
  }
};

/// Reads every chunk and checks all boxes and errors; measures the two-sided distance of each drawable to the
/// finest leaf drawables of its subtree (the source, on its lattice) at vertices and at points between them:
/// all vertices where the points suffice, an even and repeatable choice of them otherwise. What it measures
/// is a lower bound of the true distance, so a bound violation is certain; the reverse is not. A point of the
/// source that is further from the drawable than its error is left out, and must be hidden: of lines in all
/// directions but one each meets something, or meets another surface as near as that. Then the drawable must
/// be marked, and something that is not of its scene node must be no further from the point than its error:
/// so far around its box whoever selects levels looks for what is hidden or cut away. Embree (Intel) finds
/// the candidates, distances are double. Never throws for damage.
CheckReport check_pack(const Pack& pack, const CheckOptions& options = {});

/// What the bytes of a pack are worth.
struct BytesReport {
  uint64_t bytes = 0;                 ///< that have a checksum and were read
  uint64_t chunks = 0;                ///< of them, so many chunks
  uint64_t checksum_errors = 0;       ///< chunks and sections that do not verify or cannot be read
  std::vector<std::string> messages;  ///< the first of those, each with its place
};

/// Compares each chunk and each section, also of types that are not known, with its checksum; decodes nothing
/// beyond what opening the pack does. As fast as the file can be read. Never throws for damage.
BytesReport check_bytes(const Pack& pack, const CheckOptions& options = {});

}  // namespace triptych
