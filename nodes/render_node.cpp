#include "nodes/render_node.hpp"

#include "base/clock.hpp"
#include "base/notice.hpp"
#include "nodes/fallback.hpp"
#include "nodes/frame_intake.hpp"

#include <deque>
#include <set>
#include <thread>

namespace triptych {

namespace {

/// Of the ids that changed, those of scene nodes that stayed visible at another level of detail.
uint64_t level_changes(const Skeleton& skeleton, const VisibleSet& before, const VisibleSet& now) {
  const VisibleDelta delta = difference(before, now);
  std::set<SceneNodeId> removed;
  for (const DrawableId id : delta.removed) removed.insert(skeleton.drawables[id].scene_node);
  uint64_t changes = 0;
  for (const DrawableId id : delta.added) changes += removed.count(skeleton.drawables[id].scene_node) ? 2 : 0;
  return changes;
}

class RenderNode {
 public:
  RenderNode(const Pack& pack, const FrameSource& frames, const RenderNodeOptions& options)
      : pack_(pack),
        frames_(frames),
        options_(options),
        stages_(pack, fallback_options(frames.frame(frames.first).view, options)),
        peers_(options.connect, options.on_epoch_end) {}

  void run() {
    if (!options_.begin_alone) peers_.wait(frames_.frame(frames_.first));
    clock_.restart();
    for (uint32_t i = frames_.first; i < frames_.count; ++i) {
      if (stop_requested()) throw SessionEnded();
      while (next_release_ < std::min(i + in_flight, frames_.count)) release();
      draw(released_.front());
      released_.pop_front();
    }
  }

  void leave(const std::string& reason) {
    peers_.leave(reason);
    summary_.epochs = peers_.epochs();
  }
  const RenderNodeSummary& summary() const { return summary_; }

 private:
  static constexpr uint32_t in_flight = 2;

  struct Released {
    FrameRequest request;
    double at_ms;
  };

  static FallbackOptions fallback_options(const View& view, const RenderNodeOptions& options) {
    return {.width = view.width, .height = view.height, .test = options.test, .batches = options.cull};
  }

  /// The next camera is due: the switch nodes hear of it.
  void release() {
    const uint32_t i = next_release_++;
    if (options_.rate > 0) {
      const double due_ms = static_cast<double>(i - frames_.first) * 1000 / options_.rate;
      while (clock_.milliseconds() < due_ms) {
        if (stop_requested()) throw SessionEnded();
        std::this_thread::sleep_for(
            std::chrono::duration<double, std::milli>(std::min(50.0, due_ms - clock_.milliseconds())));
      }
    }
    released_.push_back({frames_.frame(i), clock_.milliseconds()});
    if (!peers_.inbox()) return;
    try {
      send(released_.back().request);
    } catch (const PeerLost& lost) {
      lose(i, lost.what(), false);
    }
  }

  void send(const FrameRequest& frame) {
    const CameraMessage message{frame.number, frame.view, frame.pixel_error,
                                frame.number + 1 == frames_.count};
    for (const Role peer : {Role::switch_0, Role::switch_1})
      peers_.inbox()->mailbox().send(peer, Channel::camera, message);
  }

  void lose(uint32_t frame, const std::string& reason, bool too_late) {
    notice("render node: frame {}: {}; goes on alone", frame, reason);
    peers_.lose(reason, too_late);
  }

  void draw(const Released& frame) {
    const VisibleSet before = visible_;
    FrameRecord record = play(frame);
    record.number = frame.request.number;
    record.frame_ms = done_ms_ - (summary_.frames == 0 ? frame.at_ms : last_done_ms_);
    record.camera_to_image_ms = done_ms_ - frame.at_ms;
    last_done_ms_ = done_ms_;
    record.visible_count = record.visible.size();
    record.level_changes = level_changes(pack_.skeleton(), before, record.visible);
    visible_ = record.visible;
    ++summary_.frames;
    summary_.alone += record.fallback;
    if (options_.on_picture) options_.on_picture(std::move(record), stages_.target());
  }

  FrameRecord play(const Released& frame) {
    const uint32_t number = frame.request.number;
    try {
      if (!peers_.inbox() && peers_.look(frame.request)) {
        if (summary_.alone > 0) notice("render node: frame {}: both switch nodes are back", number);
        visible_.clear();
        for (const Released& waiting : released_) send(waiting.request);
      }
      if (peers_.inbox()) return draw_together(frame.request);
    } catch (const PeerLost& lost) {
      lose(number, lost.what(), lost.too_late);
    } catch (const SessionEnded&) {
      if (stop_requested()) throw;
      lose(number, "a switch node left", false);
    }
    return draw_alone(frame.request);
  }

  FrameRecord draw_alone(const FrameRequest& frame) {
    stages_.resume(std::move(visible_));
    FrameRecord record = stages_.draw(frame);
    record.fallback = true;
    done_ms_ = clock_.milliseconds();
    return record;
  }

  FrameRecord draw_together(const FrameRequest& frame) {
    PictureStage& picture = stages_.picture();
    double drawing_ms = 0;
    const auto draw_more = [&](const std::vector<DrawableId>& drawables) {
      const Stopwatch stopwatch;
      picture.draw(drawables);
      drawing_ms += stopwatch.milliseconds();
    };
    Inbox& inbox = *peers_.inbox();
    picture.begin(frame.view);
    inbox.limit_waiting(options_.timeout);
    IntakeResult intake =
        take_frame(inbox, pack_.skeleton(), pack_.content_hash(), frame, visible_, draw_more);
    if (intake.digest_mismatch) {
      std::vector<DrawableId> ordered = intake.visible;
      sort_by_rank(pack_.skeleton(), eye_cell(pack_.skeleton(), frame.view), ordered);
      picture.begin(frame.view);
      draw_more(ordered);
    }
    const Stopwatch finishing;
    picture.finish();
    done_ms_ = clock_.milliseconds();
    while (inbox.report()) {  // what OR spent is in the sentinel of the next frame
    }
    FrameRecord record;
    record.render_ms = drawing_ms + finishing.milliseconds();
    record.waiting_ms = intake.waiting_ms - intake.network_ms;
    record.network_ms = intake.network_ms;
    record.hardware_cull_ms = intake.sentinel.times.hardware_cull_ms;
    record.occlusion_representation_ms = intake.sentinel.times.occlusion_representation_ms;
    record.cut_drawables = intake.sentinel.times.cut_size;
    record.tests = intake.sentinel.times.queries;
    record.added = intake.sentinel.added;
    record.removed = intake.sentinel.removed;
    record.drawn_triangles = picture.drawn_triangles();
    record.digest_mismatch = intake.digest_mismatch;
    record.visible = std::move(intake.visible);
    return record;
  }

  const Pack& pack_;
  const FrameSource& frames_;
  const RenderNodeOptions& options_;
  Fallback stages_;
  Peers peers_;
  Stopwatch clock_;
  uint32_t next_release_ = frames_.first;
  std::deque<Released> released_;  ///< cameras that are out, their pictures not yet
  double done_ms_ = 0, last_done_ms_ = 0;
  VisibleSet visible_;
  RenderNodeSummary summary_;
};

}  // namespace

RenderNodeSummary run_render_node(const Pack& pack, const FrameSource& frames,
                                  const RenderNodeOptions& options) {
  RenderNode node(pack, frames, options);
  try {
    node.run();
    node.leave("");
  } catch (const SessionEnded&) {
    node.leave("");
  } catch (const std::exception& error) {
    node.leave(error.what());
    throw;
  }
  return node.summary();
}

}  // namespace triptych
