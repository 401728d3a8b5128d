// Whether what a pack says of closed surfaces is so.
#pragma once

#include "preprocess/closed_groups.hpp"
#include "scene/chunk.hpp"
#include "scene/skeleton.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// The edges of what Skeleton::closed says is closed.
class SaidClosed {
 public:
  explicit SaidClosed(const Skeleton& skeleton);

  /// Each chunk once; on any thread.
  void add(uint32_t number, const Chunk& chunk);
  /// After all chunks. Those whose own closed surfaces are open.
  std::vector<uint32_t> open_chunks() const;
  /// Divided bodies that are open, or leave their boxes.
  std::vector<uint32_t> open_bodies() const;

 private:
  const Skeleton& skeleton_;
  std::vector<EdgeSum> alone_;       ///< of each chunk
  std::vector<EdgeSum> divided_;     ///< of each run
  std::vector<uint8_t> leaves_box_;  ///< whether a run does
};

}  // namespace triptych
