#include "nodes/render_node.hpp"

#include "base/clock.hpp"
#include "base/notice.hpp"
#include "base/timeline.hpp"
#include "nodes/frame_intake.hpp"
#include "nodes/frame_patience.hpp"
#include "nodes/frame_steering.hpp"
#include "nodes/frame_watch.hpp"
#include "nodes/level_changes.hpp"
#include "nodes/local_pipeline.hpp"
#include "nodes/received_picture.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <thread>
#include <utility>

namespace triptych {

namespace {

class RenderNode {
 public:
  RenderNode(const Pack& pack, FrameSource& source, FrameSink& sink, const RenderNodeOptions& options)
      : pack_(pack),
        source_(source),
        sink_(sink),
        numbers_(source.numbers()),
        options_(options),
        stages_(pack, {.width = 1,
                       .height = 1,
                       .cull = options.strategy,
                       .batches = options.cull,
                       .device = options.device,
                       .no_pixel_error = options.no_pixel_error,
                       .rules = options.frame_rules}),
        cost_measure_(measure_of(stages_.device().names())),
        patience_(options.timeout),
        peers_(options.connect, sink, options.stop) {}

  /// Runs until the last frame, or until this process is to end.
  void run() {
    first_ = source_.next(numbers_.first);
    streaming_ = stages_.streaming(first_->state);
    if (options_.target_ms > 0) calibrate(*first_);
    first_asked_ = first_->state.pixel_error;
    raise(*first_);
    shown_ = *first_;
    lost_ = options_.successor ? "the render node before this one ended"
                               : "the switch nodes were not both there at the beginning";
    if (!options_.successor) gather();
    clock_.restart();
    while (next_release_ < numbers_.count || !released_.empty()) {
      while (released_.size() < in_flight && next_release_ < numbers_.count && ready()) {
        if (!wait_until_due()) return;
        release();
      }
      if (options_.stop()) return;
      if (released_.empty() && source_.finished()) return;
      if (released_.empty()) {
        idle_ = true;
        tend();
        continue;
      }
      if (!draw(released_.front())) return;
      released_.pop_front();
    }
  }

  void leave(const std::string& reason) {
    peers_.leave(reason);
    summary_.epochs = peers_.epochs();
  }
  RenderNodeSummary summary() const {
    RenderNodeSummary summary = summary_;
    summary.memory = stages_.memory();
    return summary;
  }

 private:
  static constexpr uint32_t in_flight = 2;

  struct Released {
    FrameRequest request;
    double asked;             ///< the pixel error, before it was raised for want of memory
    double at_ms = 0;         ///< of the run's clock
    double sent_ms = 0;       ///< how much later it was sent to the switch nodes
    bool after_idle = false;  ///< nothing was to be drawn before it
  };

  void calibrate(FrameRequest& first) {
    steering_.emplace(pack_.skeleton(), SteeringOptions{.target_ms = options_.target_ms,
                                                        .measure = cost_measure_,
                                                        .rules = options_.frame_rules});
    stages_.resize(first.state.view.width, first.state.view.height);
    steering_->calibrate(stages_, first);
    steering_->steer(first);
    done_at_ = spent_time();
  }

  bool ready() { return first_ || source_.ready(released_.empty()); }

  /// Waits for the switch nodes, for as long as that is wanted.
  void gather() {
    const Stopwatch waiting;
    while (waiting.milliseconds() < static_cast<double>(options_.gather.count()) && !options_.stop() &&
           !source_.finished()) {
      tend();
      if (peers_.inbox()) return;
      source_.ready(false);  // a window stays alive
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    notice("render node: begins alone, the switch nodes join it when they come");
  }

  /// Looks after the switch nodes while there is nothing to draw: an epoch begins, or is over.
  void tend() {
    const uint32_t number = released_.empty() ? next_release_ : released_.front().request.number;
    if (Inbox* inbox = peers_.inbox()) {
      if (const auto ending = inbox->tend()) lose(number, *ending);
      return;
    }
    const Awaited<bool> found = peers_.look(released_.empty() ? shown_ : released_.front().request);
    if (found && *found) begin_epoch(number);
    if (!found && found.ending().cause != Ending::Cause::stopped) go_on_alone(number, found.ending().reason);
  }

  void raise(FrameRequest& frame) const {
    if (streaming_) frame.state.pixel_error = streaming_->raise(frame.state.pixel_error);
  }

  /// The first frame was requested before its release, for the warm-up.
  Released next_frame(uint32_t number) {
    if (first_) return {*std::exchange(first_, std::nullopt), first_asked_};
    FrameRequest frame = source_.next(number);
    if (steering_) steering_->steer(frame);
    const double asked = frame.state.pixel_error;
    raise(frame);
    return {std::move(frame), asked};
  }

  /// Waits until the next camera is to be released; false if this process is to end before that.
  [[nodiscard]] bool wait_until_due() {
    if (options_.rate <= 0) return !options_.stop();
    const double due_ms = static_cast<double>(next_release_ - numbers_.first) * 1000 / options_.rate;
    for (;;) {
      if (options_.stop()) return false;
      const double left_ms = due_ms - clock_.milliseconds();
      if (left_ms <= 0) return true;
      tend();
      std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(std::min(50.0, left_ms)));
    }
  }

  /// The next camera is due: sends it to the switch nodes.
  void release() {
    const uint32_t number = next_release_++;
    released_.push_back(next_frame(number));
    released_.back().after_idle = std::exchange(idle_, false);
    released_.back().at_ms = clock_.milliseconds();
    if (!peers_.inbox()) return;
    if (const auto ending = send(released_.back())) lose(number, *ending);
  }

  [[nodiscard]] std::optional<Ending> send(Released& released) {
    released.sent_ms = clock_.milliseconds() - released.at_ms;
    const FrameRequest& frame = released.request;
    return peers_.send({frame.number, frame.state, frame.number + 1 == numbers_.count});
  }

  void go_on_alone(uint32_t frame, const std::string& reason) {
    notice("render node: frame {}: {}; goes on alone", frame, reason);
    if (lost_.empty()) lost_ = reason;
  }

  void lose(uint32_t frame, const Ending& ending) {
    if (ending.cause == Ending::Cause::stopped) return;  // this process ends
    const bool left = ending.cause == Ending::Cause::session_over;
    const std::string reason = left ? "a switch node left" : ending.reason;
    go_on_alone(frame, reason);
    peers_.lose(reason, ending.too_late);
  }

  /// False if this process is to end before the picture is drawn.
  [[nodiscard]] bool draw(const Released& frame) {
    const VisibleSet before = visible_;
    shown_ = frame.request;
    watch_.begin(frame.request.number);
    std::optional<FrameRecord> drawn = draw_somehow(frame);
    watch_.end();
    if (!drawn) return false;
    FrameRecord& record = *drawn;
    record.number = frame.request.number;
    record.lost = std::exchange(lost_, {});
    record.frame_ms = done_ms_ - (summary_.frames == 0 || frame.after_idle ? frame.at_ms : last_done_ms_);
    record.camera_to_image_ms = done_ms_ - frame.at_ms;
    last_done_ms_ = done_ms_;
    record.visible_count = record.visible.size();
    record.level_changes = level_changes(pack_.skeleton(), before, record.visible);
    visible_ = record.visible;
    if (steering_) record.steered = steered(record);
    ++summary_.frames;
    summary_.fallback_frames += record.fallback;
    FrameRequest as_drawn = frame.request;
    as_drawn.state.pixel_error = record.pixel_error;
    sink_.show(as_drawn, record, stages_);
    const TimelineScope scope("hand the picture over", frame.request.number);
    sink_.picture(std::move(record), stages_.target());
    return true;
  }

  SteeredFrame steered(const FrameRecord& record) {
    SteeredFrame steered = steering_->drawn(record.number, visible_, cost_ms_);
    const SpentTime now = spent_time();
    steered.wall_ms = record.frame_ms;
    steered.undisturbed = is_undisturbed(done_at_, now);
    done_at_ = now;
    summary_.cost_coefficients = steering_->model().coefficients();
    return steered;
  }

  /// Together with the switch nodes where they are connected, otherwise by itself; nothing if this process is
  /// to end.
  std::optional<FrameRecord> draw_somehow(const Released& frame) {
    const View& view = frame.request.state.view;
    if (const FrameTarget& target = stages_.target();
        target.width() != view.width || target.height() != view.height)
      stages_.resize(view.width, view.height);
    if (!peers_.inbox()) tend();
    if (options_.stop()) return std::nullopt;
    if (peers_.inbox()) {
      Awaited<FrameRecord> record = draw_together(frame);
      if (record) return std::move(*record);
      Ending ending = record.ending();
      if (ending.cause == Ending::Cause::stopped) return std::nullopt;
      if (ending.too_late) ending.reason += fmt::format(" ({})", patience_.reason());
      lose(frame.request.number, ending);
    }
    FrameRecord record = draw_alone(frame);
    record.fallback = true;
    return record;
  }

  /// The cameras that were released already are this epoch's first.
  void begin_epoch(uint32_t number) {
    if (summary_.frames == 0 && !options_.successor) lost_.clear();  // nothing was drawn alone
    notice("render node: frame {}: both switch nodes are {}", number, peers_.epochs() > 1 ? "back" : "here");
    received_.clear();
    for (Released& released : released_) {
      if (const auto ending = send(released)) return lose(number, *ending);
    }
  }

  /// The slowest role took so long for a frame.
  void worked(double milliseconds) {
    patience_.worked(milliseconds);
    peers_.expect_frames_of(patience_.limit());
  }

  FrameRecord draw_alone(const Released& released) {
    FrameRequest frame = released.request;
    frame.state.pixel_error = released.asked;
    stages_.resume(visible_);
    const StageWatch watch;
    FrameRecord record = stages_.draw(frame);
    const SpentTime spent = watch.spent();
    cost_ms_ = cost_of(spent, cost_measure_);
    worked(spent.wall_ms);
    done_ms_ = clock_.milliseconds();
    return record;
  }

  Awaited<FrameRecord> draw_together(const Released& released) {
    const FrameRequest& frame = released.request;
    ReceivedPicture picture(stages_.picture(), streaming_, options_.session_rules);
    Inbox& inbox = *peers_.inbox();
    const FrameView view(pack_.skeleton(), frame.state, options_.frame_rules);
    picture.begin(view, frame.number);
    inbox.limit_waiting(patience_.limit());
    Awaited<IntakeResult> taken = take_frame(
        inbox, pack_.skeleton(), pack_.content_hash(), frame, received_,
        [&](const auto& decided) { picture.draw(decided); }, options_.session_rules);
    if (!taken) return taken.ending();
    IntakeResult& intake = *taken;
    if (intake.digest_mismatch) {
      std::vector<DrawableId> ordered = intake.visible;
      sort_by_rank(view, ordered);
      picture.begin(view, frame.number);
      picture.draw(ordered);
    }
    received_ = intake.visible;
    FrameRecord record;
    record.number = frame.number;
    record.pixel_error = frame.state.pixel_error;
    picture.finish(view, intake.visible, record);
    if (picture.no_room()) streaming_->refused(frame.state.pixel_error, *picture.no_room());
    if (picture.no_room() || (streaming_ && streaming_->is_too_fine(frame.state.pixel_error))) {
      record = draw_alone(released);
      record.redrawn = true;
      return record;
    }
    if (streaming_) {
      const View* next = released_.size() > 1 ? &released_[1].request.state.view : nullptr;
      streaming_->drawn(view, intake.visible, released.asked, record, next);
    }
    done_ms_ = clock_.milliseconds();
    const StageTimes& times = intake.sentinel.times;
    const bool by_wall = cost_measure_ == CostMeasure::wall;
    double culling_ms = times.hardware_cull_ms;
    double culling_cost_ms = by_wall ? times.hardware_cull_ms : times.hardware_cull_cpu_ms;
    if (const auto report = frame.number > 0 ? inbox.report(frame.number - 1) : std::nullopt) {
      record.occlusion_representation_ms = report->occlusion_representation_ms;
      culling_ms += report->occlusion_representation_ms;
      culling_cost_ms +=
          by_wall ? report->occlusion_representation_ms : report->occlusion_representation_cpu_ms;
      record_latency(record, released, *report, intake);
    }
    worked(std::max(culling_ms, picture.spent().wall_ms));
    // Switch nodes and render node work side by side.
    cost_ms_ = std::max(culling_cost_ms, cost_of(picture.spent(), cost_measure_));
    record.render_ms = picture.spent().wall_ms;
    record.waiting_ms = intake.waiting_ms - intake.network_ms;
    record.network_ms = intake.network_ms;
    record.hardware_cull_ms = times.hardware_cull_ms;
    record.cut_drawables = times.cut_size;
    record.tests = times.queries;
    record.added = intake.sentinel.added;
    record.removed = intake.sentinel.removed;
    record.drawn_triangles = stages_.picture().drawn_triangles();
    record.digest_mismatch = intake.digest_mismatch;
    record.visible = std::move(intake.visible);
    return record;
  }

  /// How long after the camera's release; `steady_ms` by this process's steady clock.
  double after_release(const Released& released, double steady_ms) const {
    return clock_.milliseconds() - (steady_milliseconds() - steady_ms) - released.at_ms;
  }

  /// The time from the camera to its picture: to the switch node, which then draws R(i), culls, and sends the
  /// sentinel; then here, until the picture is drawn.
  void record_latency(FrameRecord& record, const Released& released, const SwitchReport& report,
                      const IntakeResult& intake) const {
    const double ahead_ms = peers_.inbox()->ahead_ms(hardware_cull_role(released.request.number));
    const double began_ms = after_release(released, report.began_at_ms - ahead_ms);
    const double way_ms = std::clamp(began_ms - released.sent_ms, 0.0, report.camera_waiting_ms);
    const double sent_ms = after_release(released, intake.sent_ms);
    record.latency_known = true;
    record.latency_waiting_ms = began_ms - way_ms + report.packets_waiting_ms;
    record.latency_network_ms = way_ms + intake.network_ms;
    record.latency_render_ms = done_ms_ - released.at_ms - sent_ms - intake.network_ms;
  }

  const Pack& pack_;
  FrameSource& source_;
  FrameSink& sink_;
  FrameSource::Numbers numbers_;
  const RenderNodeOptions& options_;
  LocalPipeline stages_;
  CostMeasure cost_measure_;
  FramePatience patience_;
  FrameWatch watch_{"render node"};
  Peers peers_;
  Stopwatch clock_;
  uint32_t next_release_ = numbers_.first;
  std::deque<Released> released_;      ///< cameras that were released, whose pictures are not drawn yet
  std::optional<FrameRequest> first_;  ///< until it is released
  double first_asked_ = 0;             ///< its pixel error, before it was raised for want of memory
  Streaming* streaming_ = nullptr;     ///< of the stages, where there are caps
  FrameRequest shown_;                 ///< the last that was drawn, or the first
  bool idle_ = false;                  ///< nothing was to be drawn since the last release
  double done_ms_ = 0, last_done_ms_ = 0;
  double cost_ms_ = 0;   ///< of the last frame, in cost_measure_: what its busiest role took
  std::string lost_;     ///< why the epoch ended, for the next record
  VisibleSet visible_;   ///< that was drawn
  VisibleSet received_;  ///< of the last frame of this epoch, as HC has it
  std::optional<FrameSteering> steering_;
  SpentTime done_at_;  ///< of frames that are steered: when the last picture was done
  RenderNodeSummary summary_;
};

}  // namespace

RenderNodeSummary run_render_node(const Pack& pack, FrameSource& source, FrameSink& sink,
                                  const RenderNodeOptions& options) {
  RenderNode node(pack, source, sink, options);
  try {
    node.run();
  } catch (const std::exception& error) {
    node.leave(error.what());
    throw;
  }
  node.leave("");
  return node.summary();
}

}  // namespace triptych
