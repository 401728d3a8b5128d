// Viewpoints (view/bcf/bcf.hpp) of a model's own objects.
#pragma once

#include "scene/frame_state.hpp"
#include "scene/hidden_objects.hpp"
#include "scene/pack_objects.hpp"
#include "view/bcf/bcf.hpp"
#include "view/selected.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// The objects of these GUIDs, ascending; those that the model does not have are left out.
std::vector<SourceObjectId> objects_of(const SourceObjects& source, std::span<const std::string> guids);

/// What a person sees: the frame's section and, of what has an IFC GUID, the selection and what is hidden; or
/// what is not, if that is less.
Viewpoint viewpoint_of(const PathFrame& camera, const FrameState& frame, const SourceObjects& source,
                       const Selected& selected, const std::string& title);

/// What of that a viewpoint cannot hold, in a few words: objects without an IFC GUID. Empty where there are
/// none.
std::string not_saved_text(const FrameState& frame, const SourceObjects& source, const Selected& selected);

/// What it hides of the model: what is named with all that is in it, or all the rest.
ObjectSet hidden_by(const Viewpoint& viewpoint, const SourceObjects& source);

/// What of a viewpoint is not shown, in a few words; empty where everything is.
std::string left_out_text(const Viewpoint& viewpoint, const SourceObjects& source);

/// The time of the day as BCF writes it: "2024-05-01T12:00:00Z".
std::string time_text();

}  // namespace triptych
