// What has cut surfaces of what is drawn: closed surfaces that a section may cut, each as a whole.
#pragma once

#include "lod/representation.hpp"
#include "scene/closed_surfaces.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Triangles of a closed surface.
struct CutRun {
  uint32_t chunk = 0;
  uint32_t first_triangle = 0, triangle_count = 0;
  uint32_t item = no_id;  ///< that draws them, an index; no_id where none does: then they only count
};

/// A closed surface under a transform. Its runs are all of it, whatever of it is drawn, in a fixed order.
struct CutBody {
  uint32_t transform = 0;  ///< index into Skeleton::transforms
  uint32_t cut = 0;        ///< SectionPlace::cut, not 0
  uint32_t first_run = 0, run_count = 0;
};

/// Of the closed surfaces in the chunks of draw items those that sides of the section may go through. Keeps
/// its room from use to use.
class CutBodies {
 public:
  explicit CutBodies(const Skeleton& skeleton) : skeleton_(skeleton) {}

  /// Of each item's chunk the surfaces that it has alone, in the order of items; then those that were divided
  /// among chunks.
  void find(const FrameView& view, std::span<const DrawItem> items);
  std::span<const CutBody> all() const { return bodies_; }
  std::span<const CutRun> runs_of(const CutBody& body) const {
    return std::span(runs_).subspan(body.first_run, body.run_count);
  }
  /// Of all bodies.
  std::span<const CutRun> runs() const { return runs_; }

 private:
  struct Shown {
    uint32_t body, transform, run, item;
  };
  void add_divided(const FrameView& view, std::span<const Shown> shown);

  const Skeleton& skeleton_;
  std::vector<CutBody> bodies_;
  std::vector<CutRun> runs_;
  std::vector<Shown> shown_;  ///< what items show of divided bodies
};

}  // namespace triptych
