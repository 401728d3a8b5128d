#include "measure/frame_steps.hpp"

#include "base/clock.hpp"
#include "base/progress.hpp"
#include "measure/allocation_count.hpp"
#include "nodes/inbox.hpp"
#include "protocol/delta_codec.hpp"
#include "protocol/digest.hpp"
#include "render/draw_list.hpp"
#include "visibility/occlusion_strategy.hpp"
#include "visibility/visible_stream.hpp"

#include <algorithm>

namespace triptych {

namespace {

constexpr size_t step_count = frame_step_names.size();

/// Times one step at a time.
class StepClock {
 public:
  /// The sums over one round of one frame.
  struct Sums {
    std::array<double, step_count> microseconds{};
    std::array<uint64_t, step_count> allocations{};
  };

  void begin_frame() { sums_ = {}; }
  /// Runs the body as a part of the step; the time of steps within it is not counted.
  template <typename Body>
  auto run(FrameStep step, const Body& body) {
    const Sums before = sums_;
    const uint64_t allocations = allocation_count();
    const Stopwatch stopwatch;
    auto result = body();
    const double spent = stopwatch.milliseconds() * 1000;
    const uint64_t made = allocation_count() - allocations;
    double inner_microseconds = 0;
    uint64_t inner_allocations = 0;
    for (size_t i = 0; i < step_count; ++i) {
      inner_microseconds += sums_.microseconds[i] - before.microseconds[i];
      inner_allocations += sums_.allocations[i] - before.allocations[i];
    }
    sums_.microseconds[static_cast<size_t>(step)] += spent - inner_microseconds;
    sums_.allocations[static_cast<size_t>(step)] += made - inner_allocations;
    return result;
  }
  const Sums& sums() const { return sums_; }

 private:
  Sums sums_;
};

/// A packet as it is sent over the network.
struct EncodedPacket {
  DrawRank watermark;
  std::vector<std::byte> bytes;
};

/// Runs frames one after the other, with the steps of all roles.
class FramePlayer final : public CullSink {
 public:
  FramePlayer(const Pack& pack, const Hierarchy& hierarchy)
      : pack_(pack),
        skeleton_(hierarchy.skeleton()),
        strategy_(hierarchy),
        representation_(hierarchy),
        draw_lists_(hierarchy.skeleton()),
        cut_bodies_(hierarchy.skeleton()),
        ranges_(skeleton_.chunks.size()) {
    // As if every chunk were resident.
    for (size_t i = 0; i < ranges_.size(); ++i)
      ranges_[i].index_count = 3 * skeleton_.chunks[i].triangle_count;
  }

  void forget() { visible_.clear(); }

  const StepClock::Sums& play(const FrameRequest& frame, FrameTarget& target) {
    clock_.begin_frame();
    packets_.clear();
    const FrameView view =
        clock_.run(FrameStep::frame_view, [&] { return FrameView(skeleton_, frame.state); });
    clock_.run(FrameStep::representation, [&] {
      strategy_.representation()->begin(view, target);
      strategy_.representation()->add(visible_, target);
      return 0;
    });
    const CullResult& result =
        *clock_.run(FrameStep::hardware_cull, [&] { return &strategy_.run(view, visible_, target, *this); });
    clock_.run(FrameStep::receive_delta, [&] {
      VisibleStream stream(skeleton_, view.state, visible_);
      for (const EncodedPacket& packet : packets_)
        stream.take({packet.watermark, decode_delta(packet.bytes, visible_, "measure frame")});
      return 0;
    });
    clock_.run(FrameStep::digest,
               [&] { return frame_digest(frame.number, frame.state, pack_.content_hash(), result.visible); });
    clock_.run(FrameStep::order, [&] {
      ordered_ = result.visible;
      sorter_.sort(view, ordered_);
      return 0;
    });
    clock_.run(FrameStep::draw_list, [&] {
      items_.clear();
      list_.clear();
      representation_.begin(view);
      for (const DrawableId id : ordered_) representation_.append(id, items_);
      draw_lists_.begin(view);
      cut_bodies_.find(view, items_);
      draw_lists_.append(ranges_, items_, cut_bodies_, DrawPart::all, list_);
      return 0;
    });
    clock_.run(FrameStep::select_cut, [&] { return select_cut(view).drawables.size(); });
    visible_ = result.visible;
    return clock_.sums();
  }

  void take(const CullPacket& packet) override {
    clock_.run(FrameStep::encode_delta, [&] {
      packets_.push_back({packet.watermark, encode_delta(packet.delta, visible_)});
      return 0;
    });
  }

 private:
  const Pack& pack_;
  const Skeleton& skeleton_;
  OcclusionStrategy strategy_;
  LevelsRepresentation representation_;
  DrawListBuilder draw_lists_;
  CutBodies cut_bodies_;
  std::vector<DrawItem> items_;
  DrawList list_;
  RankSorter sorter_;
  std::vector<ChunkRange> ranges_;
  std::vector<EncodedPacket> packets_;
  VisibleSet visible_;  ///< V(i−1), until the frame is over
  std::vector<DrawableId> ordered_;
  StepClock clock_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<FrameStepSamples> measure_frame_steps(const Pack& pack, const Hierarchy& hierarchy,
                                                  Device& device, const std::vector<FrameRequest>& frames,
                                                  size_t rounds) {
  std::vector<FrameStepSamples> samples(frames.size());
  if (frames.empty() || rounds == 0) return samples;
  const View& first = frames.front().state.view;
  AnswerLog log;
  FramePlayer player(pack, hierarchy);
  Progress progress("frames", (rounds + 1) * frames.size());
  const auto one_round = [&](FrameTarget& target, const auto& take) {
    player.forget();
    for (size_t frame = 0; frame < frames.size(); ++frame) {
      take(frame, player.play(frames[frame], target));
      progress.advance();
      end_if_asked("measure frame");
    }
  };
  {
    const std::unique_ptr<FrameTarget> target =
        device.make_target(TargetKind::depth_only, first.width, first.height);
    AnswerRecorder recorder(*target, log);
    one_round(recorder, [](size_t, const StepClock::Sums&) {});
  }
  AnswerPlayer answers(log, first.width, first.height);
  std::vector<std::array<std::vector<double>, step_count>> times(frames.size());
  for (size_t round = 0; round < rounds; ++round) {
    answers.rewind();
    one_round(answers, [&](size_t frame, const StepClock::Sums& sums) {
      for (size_t step = 0; step < step_count; ++step) {
        times[frame][step].push_back(sums.microseconds[step]);
        samples[frame][step].allocations = sums.allocations[step];
      }
    });
  }
  for (size_t frame = 0; frame < frames.size(); ++frame) {
    for (size_t step = 0; step < step_count; ++step)
      samples[frame][step].microseconds = median(times[frame][step]);
  }
  return samples;
}

}  // namespace triptych
