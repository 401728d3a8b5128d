// Viewpoints (view/bcf/bcf.hpp) of a model's own objects.
#pragma once

#include "scene/frame_state.hpp"
#include "scene/pack_objects.hpp"
#include "view/bcf/bcf.hpp"
#include "view/selection.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// The objects of these GUIDs, ascending; those that the model does not have are left out.
std::vector<SourceObjectId> objects_of(const SourceObjects& source, std::span<const std::string> guids);

/// What a person sees: the frame's section and, where it has an IFC GUID, the selection.
Viewpoint viewpoint_of(const PathFrame& camera, const FrameState& frame, const SourceObjects& source,
                       const std::optional<Selection>& selection, const std::string& title);

/// What of a viewpoint is not shown, in a few words; empty where everything is. `hides`: whether whoever
/// shows it hides the objects that it says are hidden.
std::string left_out_text(const Viewpoint& viewpoint, bool hides);

/// The time of the day as BCF writes it: "2024-05-01T12:00:00Z".
std::string time_text();

}  // namespace triptych
