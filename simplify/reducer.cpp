#include "simplify/reducer.hpp"

#include "simplify/decimate.hpp"
#include "simplify/edge_collapse.hpp"
#include "simplify/meshopt_simplify.hpp"

#include <algorithm>

namespace triptych {

namespace {

class CollapseReducer : public Reducer {
 public:
  CollapseReducer(const Surface& surface, std::span<const uint8_t> locked, const LayeredPlanes& planes)
      : collapse_(surface, locked, planes) {}
  Reduced reduce_to(size_t triangles, double max_bound) override {
    const bool further = collapse_.reduce_to(triangles, max_bound);
    return {collapse_.piece(), collapse_.bound(), collapse_.errors(), further, collapse_.planes_left()};
  }
  size_t detached_triangles() const override { return collapse_.crowded_triangles(); }

 private:
  EdgeCollapse collapse_;
};

class OpenMeshReducer : public Reducer {
 public:
  OpenMeshReducer(const Surface& surface, std::span<const uint8_t> locked, const LayeredPlanes& planes)
      : decimation_(surface, locked, planes) {}
  Reduced reduce_to(size_t triangles, double) override { return {decimation_.reduce_to(triangles), {}, {}}; }
  size_t detached_triangles() const override { return decimation_.detached_triangles(); }

 private:
  Decimation decimation_;
};

class MeshoptReducer : public Reducer {
 public:
  MeshoptReducer(const Surface& surface, std::span<const uint8_t> locked, const LayeredPlanes& planes)
      : locked_(locked.begin(), locked.end()) {
    if (!planes.empty()) lock(surface, planes);
    piece_.surface = surface;
    for (uint32_t i = 0; i < surface.points.size(); ++i) piece_.sources.push_back(i);
  }
  Reduced reduce_to(size_t triangles, double) override {
    Piece next = simplify_with_meshopt(piece_.surface, locked_, triangles);
    std::vector<uint8_t> locked;
    if (!locked_.empty()) {
      for (const uint32_t source : next.sources) locked.push_back(locked_[source]);
    }
    for (uint32_t& source : next.sources) source = piece_.sources[source];
    locked_ = std::move(locked);
    piece_ = std::move(next);
    return {piece_, {}, {}};
  }

 private:
  /// The points in planes, and those beside them, which could fall into them.
  void lock(const Surface& surface, const LayeredPlanes& planes) {
    locked_.resize(surface.points.size(), 0);
    for (const Triangle& triangle : surface.triangles) {
      const auto& corners = triangle.vertices;
      const bool touches = std::any_of(corners.begin(), corners.end(),
                                       [&](uint32_t corner) { return !planes.planes_of(corner).empty(); });
      for (const uint32_t corner : corners) locked_[corner] |= touches ? 1 : 0;
    }
  }

  Piece piece_;
  std::vector<uint8_t> locked_;  ///< of the piece
};

}  // namespace

std::unique_ptr<Reducer> make_reducer(Simplifier simplifier, const Surface& surface,
                                      std::span<const uint8_t> locked, const LayeredPlanes& planes) {
  if (!surface.colors.empty()) return std::make_unique<CollapseReducer>(surface, locked, planes);
  switch (simplifier) {
    case Simplifier::openmesh:
      return std::make_unique<OpenMeshReducer>(surface, locked, planes);
    case Simplifier::meshopt:
      return std::make_unique<MeshoptReducer>(surface, locked, planes);
    case Simplifier::collapse:
      break;
  }
  return std::make_unique<CollapseReducer>(surface, locked, planes);
}

}  // namespace triptych
