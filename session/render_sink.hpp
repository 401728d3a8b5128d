// Where a render node's frames go: records, picture files, a window, a recording.
#pragma once

#include "base/progress.hpp"
#include "measure/frame_journal.hpp"
#include "measure/session_records.hpp"
#include "nodes/frame_source.hpp"
#include "session/picture_writer.hpp"
#include "session/role_command.hpp"
#include "session/session_connector.hpp"
#include "session/window_source.hpp"

#include <optional>
#include <vector>

namespace triptych {

/// Handles frames as the command says. connector: keeps the recording. window: null where there is none.
class RenderSink : public FrameSink {
 public:
  RenderSink(const RoleCommand& command, const SessionConnector& connector, WindowSource* window,
             FrameSource::Numbers numbers);

  void show(const FrameRequest& frame, const FrameRecord& record, LocalPipeline& stages) override;
  void picture(FrameRecord record, const FrameTarget& target) override;
  void clocks(const std::vector<PeerClock>& clocks) override {
    record_.clocks = clocks;
    if (window_) window_->say_together();
  }
  void epoch_ended(const Mailbox& mailbox, const std::string& reason) override;

  /// Waits until every picture is written; Error if one could not be. Then returns the role's record, whose
  /// frames are empty if they went to a journal.
  RoleRecord finish();

 private:
  void add(FrameRecord record);
  /// As a camera that the render node sent to itself, after what is hidden in it, where that is new.
  void record_fallback(const FrameRequest& frame);

  const RoleCommand& command_;
  const SessionConnector& connector_;
  WindowSource* window_;
  std::optional<FrameJournal> journal_;
  RoleRecord record_;
  HiddenName recorded_;  ///< what is hidden in the last frame that was recorded as drawn alone
  std::optional<Progress> progress_;
  PictureWriter writer_;  ///< last: its thread adds records
};

}  // namespace triptych
