// The light that a build bakes into vertices, before anything else is made of the model.
#pragma once

#include "preprocess/build.hpp"
#include "preprocess/build_work.hpp"
#include "preprocess/textures/make_textures.hpp"

namespace triptych {

/// bake_light(), in units of the build. texels: of the textures, by which surfaces reflect light. Says where
/// nothing is computed, since there is no emitter.
Model bake_light_in_build(Model model, const BuildOptions& options, const Textures& textures,
                          const SpoolFile& texels, BuildWork& work, LightReport& report);

}  // namespace triptych
