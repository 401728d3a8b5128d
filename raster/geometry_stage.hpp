// From a stretch of a chunk to triangles that can be filled.
#pragma once

#include "raster/cut_out.hpp"
#include "raster/kernel_triangles.hpp"
#include "raster/simd/kernels.hpp"
#include "raster/slots.hpp"
#include "raster/triangle.hpp"
#include "visibility/screen_bounds.hpp"

#include <span>
#include <vector>

namespace triptych {

/// What one stretch of triangles becomes. Keeps its room from use to use.
struct StretchTriangles {
  KernelTriangles kernel;
  std::vector<WindowTriangle> small, large;  ///< the others, with their slots
  std::vector<CutOutTriangle> cut_out;       ///< and those that have holes
  std::vector<DepthLimit> limits;            ///< of the chunk's pieces; triangles point to them
  int32_t bottom = 0, top = -1;              ///< rows that any of them has pixels in
};

/// What is the same for all that is drawn into one picture, or into one sample of each of its pixels.
struct GeometryTerms : VertexStage {
  GeometryTerms(const FrameView& view, const BoxProjector& projector, const SamplePlace& place = {});

  const BoxProjector* projector;
  LayerOffset layers;
  SamplePlace sample;
  WindowTransform window;
  PictureLimits limits;
  SectionSidesOver sides;                      ///< of the section, if there is one
  const TextureLevels* textures = nullptr;     ///< where something is cut out
  std::span<const SurfaceMaterial> materials;  ///< Skeleton::materials

  /// For the kernels of an instruction set.
  TransformTerms transform_terms(const PlacedLattice& placed) const;
  LayerTerms layer_terms() const;
};

/// range: numbered. pieces: boxes of the chunk's
/// pieces, placed. Depths of `triangles` keep the limits of their piece: by a proof, or by
/// FillTriangle::limit. Those that lie behind what is drawn already may be left out. A function of its
/// arguments alone.
void make_triangles(const GeometryTerms& terms, const DrawnRange& range, std::span<const LatticeBox> pieces,
                    const DepthSource& drawn, StretchTriangles& result);

}  // namespace triptych
