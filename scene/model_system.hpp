// The coordinates of a model's own files, beside those of the pack, which are metres with y up.
#pragma once

#include "scene/pack_options.hpp"

#include <glm/vec3.hpp>
#include <string>

namespace triptych {

/// Origins are the same: nothing is moved on the way into a pack.
struct ModelSystem {
  bool z_up = false;
  double metres = 1;       ///< of one unit
  std::string unit = "m";  ///< its name

  /// A place or direction of the pack's in the files' coordinates.
  glm::dvec3 own(const glm::dvec3& model) const {
    return (z_up ? glm::dvec3(model.x, -model.z, model.y) : model) / metres;
  }
  double own_length(double model) const { return model / metres; }
  bool operator==(const ModelSystem&) const = default;
};

/// Of a pack, by what it says of how it was built: "model-up" and "model-unit", where all of its files have
/// the same ones. Metres, y up, where it does not say.
ModelSystem model_system(const PackOptions& options);
/// Those two words.
void say_system(const ModelSystem& system, PackOptions& options);

}  // namespace triptych
