#include "measure/accuracy/accuracy.hpp"

#include "base/progress.hpp"
#include "base/signals.hpp"
#include "measure/accuracy/accuracy_ground.hpp"
#include "measure/accuracy/accuracy_promises.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

namespace {

constexpr const char* stage = "measure accuracy";

/// Which frames are compared: spread evenly, each with the two before it kept.
std::vector<FramePlan> plan_frames(size_t frames, const AccuracyOptions& options) {
  std::vector<FramePlan> plans(frames);
  const size_t count = std::min(frames, std::max<size_t>(options.compared_frames, 1));
  const size_t perceptual = std::min(count, options.perceptual_frames);
  for (size_t i = 0; i < count; ++i) {
    // In the middle of each of `count` stretches, so that frames before it are known.
    const size_t frame = (2 * i + 1) * frames / (2 * count);
    plans[frame].compare = true;
    plans[frame].exhibit = i == count / 2;
    plans[frame].perceptual = perceptual > 0 && i * perceptual / count != (i + 1) * perceptual / count;
    for (size_t back = 1; back <= std::min<size_t>(2, frame); ++back) plans[frame - back].keep = true;
  }
  return plans;
}

void find_deviations(AccuracyResult& result) {
  std::vector<const PictureTally*> seen;
  for (size_t row = 0; row < result.rows.size(); ++row) {
    const PictureTally& pictures = *result.rows[row].pictures;
    if (std::count(seen.begin(), seen.end(), &pictures) > 0) continue;  // another row's are the same
    seen.push_back(&pictures);
    const WorstDeviation& worst = pictures.worst_deviation;
    const double limit = tolerated_deviation(result.rows[row].pixel_error);
    if (!(worst.point.pixels > limit)) continue;
    const auto above = std::count_if(pictures.deviations.begin(), pictures.deviations.end(),
                                     [&](float pixels) { return double{pixels} > limit; });
    result.violations.push_back(
        {row,
         fmt::format("{} points deviate by more than {:g} pixels, the farthest by {:.3g}", above,
                     result.rows[row].pixel_error, worst.point.pixels),
         worst.frame, worst.point});
  }
}

}  // namespace

double tolerated_deviation(double pixel_error) { return pixel_error * 1.0001 + 1e-4; }

AccuracyResult measure_accuracy(std::span<const AccuracySubject> subjects,
                                std::span<const std::vector<FrameRequest>> paths,
                                const AccuracyOptions& options) {
  AccuracyResult result;
  const std::optional<Butteraugli> perceptual = Butteraugli::find();
  result.perceptual = perceptual.has_value();
  std::vector<std::unique_ptr<PackSurfaces>> surfaces;
  std::vector<std::unique_ptr<AccuracyGround>> grounds;
  struct Turn {
    AccuracyGround* ground;
    size_t setting;
  };
  std::vector<Turn> turns;
  for (const AccuracySubject& subject : subjects) {
    surfaces.push_back(std::make_unique<PackSurfaces>(subject.pack));
    for (const SpeedDevice& device : subject.devices) {
      for (const std::vector<FrameRequest>& frames : paths) {
        grounds.push_back(std::make_unique<AccuracyGround>(subject, device, *surfaces.back(), frames, options,
                                                           perceptual, result));
        for (size_t setting = 0; setting < grounds.back()->turns(); ++setting)
          turns.push_back({grounds.back().get(), setting});
      }
    }
  }
  const size_t frames = paths.front().size();
  const std::vector<FramePlan> plans = plan_frames(frames, options);
  Progress progress(stage, frames);
  for (size_t frame = 0; frame < frames; ++frame) {
    for (const auto& ground : grounds) {
      ground->begin(frame, plans[frame]);
      end_if_asked(stage);
    }
    for (size_t turn = 0; turn < turns.size(); ++turn) {
      const Turn& next = turns[(turn + frame) % turns.size()];
      next.ground->draw(next.setting, frame, plans[frame]);
      end_if_asked(stage);
    }
    progress.advance();
  }
  find_deviations(result);
  find_broken_promises(result);
  return result;
}

}  // namespace triptych
