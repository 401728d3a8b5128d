// What frames are held against that need neither a hierarchy nor levels: all triangles in one draw, and a ray
// tracer.
#pragma once

#include "measure/speed_method.hpp"
#include "scene/flat_model.hpp"
#include "scene/frame_state.hpp"

#include <cstdint>
#include <memory>
#include <span>

namespace triptych {

/// `everything`: the model in one draw of OpenGL, without culling or levels of detail. A context must be
/// current, and the model must outlive it. Error where OpenGL has no room.
std::unique_ptr<SpeedMethod> make_everything_method(const FlatModel& model, const Skeleton& skeleton,
                                                    std::span<const FrameRequest> frames);

/// `embree`: one primary ray a sample (measure/primary_rays.hpp). The model must outlive it. Null where the
/// tree takes more bytes than that.
std::unique_ptr<SpeedMethod> make_embree_method(const FlatModel& model, std::span<const FrameRequest> frames,
                                                uint64_t max_tree_bytes);

}  // namespace triptych
