// Pipes, ducts and trays along a line with square corners: pieces no longer than they are sold, bends at the
// corners, joints between pieces, hangers.
#pragma once

#include "samples/services/object_scene.hpp"

#include <functional>
#include <string>
#include <vector>

namespace triptych {

struct PipeSystem {
  std::string name;
  glm::dvec3 colour{0};
  double diameter = 0.02;
  bool insulated = false;
  double piece = 3;  ///< the longest, metres
};

struct DuctSystem {
  std::string name;
  glm::dvec3 colour{0};
};

/// How often something hangs from the slab above, along what lies level; 0: it is carried otherwise.
struct Hanging {
  double spacing = 0;
};

/// The corners of a run turn square, between two of the three axes; metres.
using Route = std::vector<glm::dvec3>;

void lay_pipe(const Placer& placer, const PipeSystem& system, const Route& route,
              const Hanging& hanging = {});
void lay_round_duct(const Placer& placer, const DuctSystem& system, double diameter, const Route& route,
                    const Hanging& hanging = {});
/// A level route only.
void lay_duct(const Placer& placer, const DuctSystem& system, double width, double height, const Route& route,
              const Hanging& hanging = {}, bool insulated = false);
/// A level route only.
void lay_tray(const Placer& placer, const std::string& name, double width, int cables, const Route& route);

/// Direction 0: along x; what a part's transform is where it lies level or stands up.
glm::dmat4 laid(const glm::dvec3& from, const glm::dvec3& direction);

}  // namespace triptych
