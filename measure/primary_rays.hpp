// A ray tracer beside which frames are measured: Embree, one primary ray a sample, against a whole model.
#pragma once

#include "scene/camera.hpp"
#include "scene/flat_model.hpp"
#include "scene/section.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace triptych {

/// One flat scene of all triangles, its tree built beforehand; coherent packets as wide as the processor has
/// them, over all cores. What is hit is shaded as the device `gl` shades it: at each sample by itself, and a
/// pixel is the mean of its samples, halves up.
class PrimaryRays {
 public:
  /// Builds the tree; null where it does not fit into so many bytes. The model must outlive it. Error
  /// (Embree) where Embree refuses for another reason.
  static std::unique_ptr<PrimaryRays> build(const FlatModel& model,
                                            uint64_t max_bytes = std::numeric_limits<uint64_t>::max());
  ~PrimaryRays();
  PrimaryRays(const PrimaryRays&) = delete;
  PrimaryRays& operator=(const PrimaryRays&) = delete;

  /// What the section keeps: each ray is held to the stretch that lies in it. There are no cut surfaces.
  /// samples: a pixel (scene/sample_places.hpp).
  void draw(const View& view, const Section& section = {}, uint32_t samples = 1);
  /// Of the last draw: width × height × RGBA bytes, rows from bottom to top.
  const std::vector<uint8_t>& colors() const { return colors_; }

  double build_seconds() const;
  /// What the tree takes, without the model's own vertices and indices.
  uint64_t memory_bytes() const;

 private:
  struct Tree;
  PrimaryRays(const FlatModel& model, std::unique_ptr<Tree> tree);

  const FlatModel& model_;
  std::unique_ptr<Tree> tree_;
  std::vector<uint8_t> colors_;
};

}  // namespace triptych
