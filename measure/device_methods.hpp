// What one device is measured with: the local pipeline, and what it is held against on the same cut.
#pragma once

#include "lod/hierarchy.hpp"
#include "measure/speed_method.hpp"
#include "scene/frame_state.hpp"
#include "visibility/device.hpp"
#include "visibility/visible_set.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// A device of the pack, by the name that --device takes. Both references must outlive the methods.
struct SpeedDevice {
  std::string name;
  const Hierarchy& hierarchy;
  Device& device;
};

/// Of each frame the drawables that own a sample of its un-culled picture. Loads all that the frames draw.
std::vector<VisibleSet> owners_of_frames(const SpeedDevice& device, std::span<const FrameRequest> frames);

/// `triptych`: the local pipeline with the strategy `occlusion`.
std::unique_ptr<SpeedMethod> make_triptych_method(const SpeedDevice& device,
                                                  std::span<const FrameRequest> frames);
/// `frustum`: the whole cut in draw rank order, without a test of drawables or boxes.
std::unique_ptr<SpeedMethod> make_frustum_method(const SpeedDevice& device,
                                                 std::span<const FrameRequest> frames);
/// `frustum-hidepth`: the same cut in the same order; drawables whose boxes are behind what is drawn so far
/// are passed over. For devices where that is known without a round trip.
std::unique_ptr<SpeedMethod> make_frustum_hidepth_method(const SpeedDevice& device,
                                                         std::span<const FrameRequest> frames);
/// `oracle`: exactly the given drawables, as if somebody had known them before: what no exact culling on this
/// cut goes below. Their selection (of them and what lies above them alone) and their order are in its time.
std::unique_ptr<SpeedMethod> make_oracle_method(const SpeedDevice& device,
                                                std::span<const FrameRequest> frames,
                                                std::span<const VisibleSet> owners);

}  // namespace triptych
