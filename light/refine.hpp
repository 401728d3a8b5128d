// Triangles made smaller where light changes.
#pragma once

#include "light/gather.hpp"
#include "light/run_points.hpp"

namespace triptych {

/// Divides edges, in rounds, as LightOptions says, by direct light and openness: the light halfway along an
/// edge is gathered, and compared with what is interpolated from its ends (adaptive subdivision: Cohen,
/// Greenberg, Immel and Brock, An efficient radiosity approach for realistic image synthesis, 1986). scene:
/// of the model before. Stops, with a warning, where triangles would take more than the memory.
void refine(LitModel& model, const LitScene& scene, const Emitters& emitters, const LightOptions& options,
            const RunPoints& run, LightReport& report);

/// The irradiance under which a white surface shows as white, so that a typical model is well exposed: 5/3 of
/// the median of what is lit, by area. 0 if nothing is.
double white_irradiance(const LitModel& model, std::span<const glm::vec3> irradiance);

}  // namespace triptych
