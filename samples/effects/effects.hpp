// The sample `effects`: a small exhibition that calls for every effect that the program draws, and twins that
// call for one of them, or for none.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace triptych {

struct EffectsFile {
  std::string name;
  std::string effects;  ///< as `--effects` has them
  std::string build;    ///< the flags of `build` without which it has none of those, or not all; else empty
};

struct EffectsReport {
  std::vector<EffectsFile> files;
  size_t objects = 0;
  uint64_t triangles = 0;  ///< of each file
};

/// Writes `scene.gltf` with all effects, `plain.gltf` with none, and a file named after each effect with that
/// one alone, their buffers, and the paths `walk.json`, `fly.json`, `spin.json` and `jump.json`. What is
/// baked, the build is to be asked for. All files
/// have the same triangles: coloured glass stands in rows, in cases around figures, and before a relief whose
/// corners have colours; figures and relief are round by the normals of their corners; a carpet has a
/// texture, a fence one with holes, and lamps glow, beside points that give light; a door with a knob swings,
/// and a fan turns. The images stand beside the scenes. Frames of the paths name times, a thirtieth of a
/// second apart.
EffectsReport make_effects(const std::filesystem::path& folder);

}  // namespace triptych
