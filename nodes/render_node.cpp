#include "nodes/render_node.hpp"

#include "base/clock.hpp"
#include "base/timeline.hpp"
#include "nodes/frame_intake.hpp"

#include <thread>

namespace triptych {

namespace {

class RenderNode {
 public:
  RenderNode(const Pack& pack, Mailbox& mailbox, const std::vector<FrameRequest>& frames,
             const RenderNodeOptions& options)
      : pack_(pack),
        inbox_(mailbox),
        frames_(frames),
        options_(options),
        renderer_(pack),
        picture_(renderer_, frames.front().view.width, frames.front().view.height),
        released_ms_(frames.size()) {}

  void run() {
    compare_clocks();
    constexpr size_t in_flight = 2;
    for (size_t i = 0; i < std::min(in_flight, frames_.size()); ++i) release(i);
    for (size_t i = 0; i < frames_.size(); ++i) {
      draw(i);
      if (i + in_flight < frames_.size()) release(i + in_flight);
    }
    collect_reports();
  }

  std::vector<FrameRecord> records() && { return std::move(records_); }

 private:
  void compare_clocks() {
    std::vector<PeerClock> clocks;
    for (const Role peer : {Role::switch_0, Role::switch_1}) clocks.push_back(inbox_.clock_of(peer));
    if (options_.on_clocks) options_.on_clocks(clocks);
  }

  void release(size_t i) {
    if (options_.rate > 0) {
      const double due_ms = static_cast<double>(i) * 1000 / options_.rate;
      while (clock_.milliseconds() < due_ms) {
        if (stop_requested()) throw SessionEnded();
        std::this_thread::sleep_for(
            std::chrono::duration<double, std::milli>(std::min(50.0, due_ms - clock_.milliseconds())));
      }
    }
    released_ms_[i] = clock_.milliseconds();
    const FrameRequest& frame = frames_[i];
    const CameraMessage message{frame.number, frame.view, frame.pixel_error, i + 1 == frames_.size()};
    inbox_.mailbox().send(Role::switch_0, Channel::camera, message);
    inbox_.mailbox().send(Role::switch_1, Channel::camera, message);
  }

  void draw(size_t i) {
    const FrameRequest& frame = frames_[i];
    FrameRecord record{.number = frame.number};
    double drawing_ms = 0;
    const auto draw_more = [&](const std::vector<DrawableId>& drawables) {
      const Stopwatch stopwatch;
      picture_.draw(drawables);
      drawing_ms += stopwatch.milliseconds();
    };
    picture_.begin(frame.view, frame.number);
    IntakeResult intake =
        take_frame(inbox_, pack_.skeleton(), pack_.content_hash(), frame, visible_, draw_more);
    if (intake.digest_mismatch) {
      std::vector<DrawableId> ordered = intake.visible;
      sort_by_rank(pack_.skeleton(), eye_cell(pack_.skeleton(), frame.view), ordered);
      picture_.begin(frame.view, frame.number);
      draw_more(ordered);
    }
    const Stopwatch finishing;
    picture_.finish();
    visible_ = intake.visible;
    const double done_ms = clock_.milliseconds();
    record.render_ms = drawing_ms + finishing.milliseconds();
    record.waiting_ms = intake.waiting_ms - intake.network_ms;
    record.frame_ms = done_ms - (i == 0 ? released_ms_[0] : last_done_ms_);
    record.camera_to_image_ms = done_ms - released_ms_[i];
    record.hardware_cull_ms = intake.sentinel.times.hardware_cull_ms;
    record.occlusion_representation_ms = intake.sentinel.times.occlusion_representation_ms;
    record.cut_drawables = intake.sentinel.times.cut_size;
    record.tests = intake.sentinel.times.queries;
    record.added = intake.sentinel.added;
    record.removed = intake.sentinel.removed;
    record.drawn_triangles = picture_.drawn_triangles();
    record.digest_mismatch = intake.digest_mismatch;
    record.visible = std::move(intake.visible);
    record.network_ms = intake.network_ms;
    last_done_ms_ = done_ms;
    if (options_.on_picture) {
      const TimelineScope scope("hand the picture over", frame.number);
      options_.on_picture(record, picture_.target());
    }
    records_.push_back(std::move(record));
  }

  void collect_reports() {
    while (inbox_.report()) {
    }
  }

  const Pack& pack_;
  Inbox inbox_;
  const std::vector<FrameRequest>& frames_;
  const RenderNodeOptions& options_;
  Renderer renderer_;
  PictureStage picture_;
  Stopwatch clock_;
  std::vector<double> released_ms_;
  double last_done_ms_ = 0;
  VisibleSet visible_;
  std::vector<FrameRecord> records_;
};

}  // namespace

std::vector<FrameRecord> run_render_node(const Pack& pack, Mailbox& mailbox,
                                         const std::vector<FrameRequest>& frames,
                                         const RenderNodeOptions& options) {
  RenderNode node(pack, mailbox, frames, options);
  try {
    node.run();
    mailbox.leave("");
  } catch (const SessionEnded&) {
    mailbox.leave("");
    if (!stop_requested()) fail("session", "a switch node left before the last frame");
  } catch (const PeerLost&) {
    mailbox.leave("");
    throw;
  } catch (const std::exception& error) {
    mailbox.leave(error.what());
    throw;
  }
  return std::move(node).records();
}

}  // namespace triptych
