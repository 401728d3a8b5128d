// What light a build bakes into vertices, and what came of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

struct LightOptions {
  bool bake = false;       ///< the light of the model's emitters
  bool ambient = false;    ///< how open the surroundings of each vertex are
  uint32_t samples = 256;  ///< rays over the hemisphere of each vertex, for each bounce
  uint32_t bounces = 4;    ///< of light between surfaces, after it has left its emitter
  /// Edges are divided while light half-way along them differs by more than this from what is interpolated,
  /// in units of the irradiance under which a white surface shows as white.
  double threshold = 0.05;
  /// Edges shorter than this are not divided, longer than that always are; of the model's diagonal.
  double shortest_edge = 1.0 / 512, longest_edge = 1.0 / 24;
  /// How far surfaces shade each other as ambient occlusion; of the model's diagonal.
  double reach = 1.0 / 16;
  uint64_t seed = 0;  ///< of the rays' directions
  /// What the model and its refined copy may take about, bytes.
  uint64_t memory = uint64_t{1} << 30;

  bool any() const { return bake || ambient; }
};

/// Luminance of an emissive surface whose factor is 1, cd/m².
inline constexpr double emission_luminance = 1000;
/// Luminous flux of a luminaire of IFC, lumen: files seldom say theirs.
inline constexpr double luminaire_flux = 2000;

struct LightReport {
  uint64_t lights = 0, emissive_triangles = 0, luminaires = 0;  ///< emitters
  uint64_t triangles = 0;                                       ///< of all placements, before
  uint64_t refined_triangles = 0;                               ///< and after refinement
  uint64_t unshared_triangles = 0;      ///< of placements that shared a mesh, and now have their own
  uint64_t points = 0;                  ///< where light is gathered
  uint64_t clipped_points = 0;          ///< brighter than can be told (most_irradiance)
  double white_lux = 0;                 ///< the irradiance under which a white surface shows as white
  bool baked = false, ambient = false;  ///< what there is
  std::vector<std::string> warnings = {};
};

}  // namespace triptych
