#include "session/render_sink.hpp"

#include "base/hashing.hpp"
#include "scene/hidden_objects.hpp"
#include "session/pictures.hpp"

#include <utility>

namespace triptych {

RenderSink::RenderSink(const RoleCommand& command, const SessionConnector& connector, WindowSource* window,
                       FrameSource::Numbers numbers)
    : command_(command),
      connector_(connector),
      window_(window),
      // A person's walk does not end because a disk is full.
      writer_(window ? PictureWriter::OnFailure::say : PictureWriter::OnFailure::stop) {
  if (!command.journal.empty()) journal_.emplace(command.journal);
  if (numbers.first < numbers.count)
    progress_.emplace("session", window || command.until_told ? 0 : numbers.count - numbers.first);
}

void RenderSink::show(const FrameRequest& frame, const FrameRecord& record, LocalPipeline& stages) {
  if (record.fallback) record_fallback(frame);
  if (window_) window_->show(frame, record, stages);
}

void RenderSink::record_fallback(const FrameRequest& frame) {
  const Hiding& hiding = frame.state.hiding;
  if (hiding.objects && hiding.name != recorded_)
    connector_.record_own(HiddenSet{frame.number, hiding.objects->objects()});
  recorded_ = hiding.name;
  connector_.record_own(CameraMessage{frame.number, frame.state});
}

void RenderSink::picture(FrameRecord record, const FrameTarget& target) {
  progress_->advance();
  if (!command_.hash && command_.output.empty()) return add(std::move(record));
  std::vector<uint8_t> colors = target.read_colors();
  if (command_.hash) record.picture_hash = hash_values(std::span<const uint8_t>(colors));
  if (command_.output.empty()) return add(std::move(record));
  const std::filesystem::path file = command_.output / picture_name(record.number);
  // A frame counts as drawn once its picture is there.
  writer_.add(file, target.width(), target.height(), std::move(colors),
              [this, record = std::move(record)] { add(record); });
}

void RenderSink::epoch_ended(const Mailbox& mailbox, const std::string& reason) {
  if (window_ && !reason.empty()) window_->say_alone(reason);
  add_sockets(record_.sockets, sockets_of(Role::render, mailbox));
  add_backlog(record_.max_backlog, mailbox.max_backlog());
  recorded_ = {};  // a replay keeps the last few sets, and the epoch may have had many
}

void RenderSink::add(FrameRecord record) {
  if (!command_.hash) record.visible = {};  // sets are only kept on request
  if (journal_) return journal_->add(record);
  record_.frames.push_back(std::move(record));
}

RoleRecord RenderSink::finish() {
  progress_.reset();
  writer_.finish();
  return std::move(record_);
}

}  // namespace triptych
