// What each role of a session takes for a frame when it runs alone, played from the session's recordings.
#pragma once

#include "nodes/frame_source.hpp"
#include "protocol/recording.hpp"
#include "scene/pack.hpp"
#include "visibility/device.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace triptych {

/// The messages of a session of one epoch, of one role.
struct RoleRecording {
  Role role = Role::render;
  std::string file;
  RecordingHeader header;
  std::vector<RecordedMessage> messages;
};

/// Those of the three roles, render node first. Error (file) where one is missing, is cut or damaged, is
/// of another session, where roles were restarted, or the render node drew a frame alone: then a role cannot
/// be played from its recording.
std::vector<RoleRecording> read_session_recording(const std::filesystem::path& folder);

/// The frames of the session, as its render node had them. pack must outlive the result.
std::vector<FrameRequest> recorded_frames(const Pack& pack, const RoleRecording& render);

/// Milliseconds, one value for each frame.
struct SwitchNodeTimes {
  std::vector<double> hardware_cull, occlusion_representation;  ///< of the frames in which it was that
};

/// Runs the role alone on all cores, its peers played. strategy: what the session culled by. Empty where the
/// process was told to end. Error (file) where the role does not send what it sent in the session.
SwitchNodeTimes time_switch_node(const Pack& pack, const RoleRecording& recording,
                                 const DeviceOptions& device, StrategyKind strategy);
/// The same for the render node: from picture to picture.
std::vector<double> time_render_node(const Pack& pack, const RoleRecording& recording,
                                     const std::vector<FrameRequest>& frames, const DeviceOptions& device);
/// The local pipeline on the same frames, in one process. Empty where the process was told to end.
std::vector<double> time_local_pipeline(const Pack& pack, const std::vector<FrameRequest>& frames,
                                        const DeviceOptions& device, StrategyKind strategy);

}  // namespace triptych
