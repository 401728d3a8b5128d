// Pictures of every frame, in one process: what was culled against what was not.
#include "nodes/local_pipeline.hpp"
#include "scene/hidden_objects.hpp"
#include "scene/layers.hpp"
#include "tests/hard_cases/trials.hpp"
#include "tests/support/pictures.hpp"
#include "visibility/shading.hpp"

#include <algorithm>
#include <array>
#include <fmt/core.h>

namespace triptych::hard_cases {

namespace {

LocalPipelineOptions options(const Trial& trial, StrategyKind cull, const DeviceOptions& device) {
  return {.width = trial.views[0].width, .height = trial.views[0].height, .cull = cull, .device = device};
}

class PictureTrial {
 public:
  PictureTrial(const Trial& trial, const DeviceOptions& device)
      : trial_(trial),
        device_kind_(device.kind),
        built_(trial),
        culled_(built_.pack(), options(trial, StrategyKind::occlusion, device)),
        whole_(built_.pack(), options(trial, StrategyKind::frustum, device)),
        everything_(built_.pack(), options(trial, StrategyKind::none, device)),
        portals_(built_.pack(), options(trial, StrategyKind::portals, device)),
        unbounded_(built_.pack(), without_fragment_bound(options(trial, StrategyKind::frustum, device))),
        with_backs_(built_.pack(), with_backs(options(trial, StrategyKind::frustum, device))),
        items_(built_.pack(), with_items(options(trial, StrategyKind::frustum, device))),
        sampled_(built_.pack(), options(trial, StrategyKind::occlusion, device)),
        sampled_whole_(built_.pack(), options(trial, StrategyKind::frustum, device)) {
    if (!trial.twin) return;
    built_twin_.emplace(*trial.twin);
    twin_.emplace(built_twin_->pack(), options(*trial.twin, StrategyKind::occlusion, device));
  }

  Problems run() {
    for (size_t i = 0; i < trial_.views.size() && problems_.size() < 5; ++i) {
      frame_ = i;
      FrameState state = trial_.state_of(i);
      if (!trial_.hidden.empty())
        state.hiding = hide(built_.pack().skeleton(), objects_, trial_.hidden[i], "trial");
      const FrameRequest request{static_cast<uint32_t>(i), state};
      const FrameRecord record = culled_.draw(request);
      const std::vector<uint8_t> picture = culled_.target().read_colors();
      if (i % 8 == 0) compare_sampled(request);
      if (trial_.stands_still && i > 2) {
        expect_rest(record, picture);
        continue;
      }
      compare(picture, whole_, request, "the un-culled picture");
      compare(picture, everything_, request, "the picture of the whole model");
      compare(picture, portals_, request, "what shows through portals");
      // The rasteriser's depths keep their bounds of themselves, those of slivers too; cut surfaces do not.
      if ((!trial_.slivers || device_kind_ == DeviceKind::cpu) && trial_.sections.empty())
        compare(picture, unbounded_, request, "the picture without a bound of fragments");
      compare_with_backs(picture, request);
      items_.draw(request);
      const VisibleSet truth = owners(items_.target().read_items());
      shown_ += truth.size();
      const VisibleSet missing = difference(record.visible, truth).added;
      if (!missing.empty())
        say(fmt::format("{} drawables show and are not in the visible set", missing.size()));
      if (trial_.closed) expect_closed(request);
      if (trial_.no_blue) expect_no_blue(request);
      if (twin_) {
        twin_->draw({static_cast<uint32_t>(i), {trial_.twin->views[i], trial_.twin->pixel_error}});
        const size_t pixels = test::differing_pixels(picture, twin_->target().read_colors());
        if (pixels > 0) say(fmt::format("{} pixels differ from the twin's", pixels));
      }
      last_ = record.visible;
      last_picture_ = picture;
    }
    if (shown_ == 0 && !trial_.may_be_empty) problems_.push_back("nothing shows in any frame");
    return std::move(problems_);
  }

 private:
  static LocalPipelineOptions with_items(LocalPipelineOptions options) {
    options.item_buffer = true;
    return options;
  }

  static LocalPipelineOptions without_fragment_bound(LocalPipelineOptions options) {
    options.rules.fragment_bound = false;
    return options;
  }

  static LocalPipelineOptions with_backs(LocalPipelineOptions options) {
    options.rules.leave_out_backs = false;
    return options;
  }

  void say(const std::string& what) { problems_.push_back(fmt::format("frame {}: {}", frame_, what)); }

  void compare(const std::vector<uint8_t>& picture, LocalPipeline& other, const FrameRequest& request,
               const std::string& name) {
    other.draw(request);
    const size_t pixels = test::differing_pixels(picture, other.target().read_colors());
    if (pixels > 0) say(fmt::format("{} pixels differ from {}", pixels, name));
  }

  /// The culled picture of several samples a pixel, with edges.
  void compare_sampled(FrameRequest request) {
    request.state.samples = std::array<uint32_t, 3>{4, 16, 8}[request.number / 8 % 3];
    request.state.edges = true;
    sampled_.draw(request);
    compare(sampled_.target().read_colors(), sampled_whole_, request,
            fmt::format("the un-culled one of {} samples", request.state.samples));
  }

  /// Backs that are left out change nothing but where they tie with what is before them, as at outlines on
  /// gl, whose depths are interpolated with less care; and nowhere may be seen what is behind.
  void compare_with_backs(const std::vector<uint8_t>& picture, const FrameRequest& request) {
    // A front that something lies on is drawn a little behind, and so may be behind its own edge's back.
    const bool layered = has_layers(built_.pack().skeleton().effects);
    if (!trial_.thin && !layered && device_kind_ == DeviceKind::cpu) {
      compare(picture, with_backs_, request, "the picture with the backs of solids");
      return;
    }
    with_backs_.draw(request);
    const std::vector<uint8_t> other = with_backs_.target().read_colors();
    size_t holes = 0;
    for (size_t i = 0; i < picture.size(); i += 4) {
      const auto is_empty = [&](const std::vector<uint8_t>& colors) {
        return std::equal(background_bytes.begin(), background_bytes.end(), &colors[i]);
      };
      holes += is_empty(picture) != is_empty(other);
    }
    if (holes > 0) say(fmt::format("{} pixels show the background without the backs of solids", holes));
  }

  void expect_no_blue(FrameRequest request) {
    for (const double pixel_error : {0.0, 1.0}) {
      request.state.pixel_error = pixel_error;
      whole_.draw(request);
      const std::vector<uint8_t> colors = whole_.target().read_colors();
      size_t blue = 0;
      for (size_t i = 0; i < colors.size(); i += 4) blue += colors[i] == 0 && colors[i + 2] > 0;
      if (blue > 0) say(fmt::format("{} pixels are blue at a pixel error of {}", blue, pixel_error));
    }
  }

  /// Levels of detail move outlines, but open no surface: where full detail shows something for two pixels
  /// all round, something shows.
  void expect_closed(FrameRequest request) {
    request.state.pixel_error = 0;
    items_.draw(request);
    const std::vector<uint32_t> truth = items_.target().read_items();
    const View& view = request.state.view;
    const auto is_inside = [&](int x, int y, int margin) {
      for (int row = y - margin; row <= y + margin; ++row) {
        for (int column = x - margin; column <= x + margin; ++column) {
          if (row < 0 || column < 0 || row >= view.height || column >= view.width) continue;
          if (truth[static_cast<size_t>(row * view.width + column)] == 0) return false;
        }
      }
      return true;
    };
    for (const double pixel_error : {1.0, 4.0, 16.0}) {
      request.state.pixel_error = pixel_error;
      items_.draw(request);
      const std::vector<uint32_t> items = items_.target().read_items();
      size_t holes = 0;
      for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x)
          holes += items[static_cast<size_t>(y * view.width + x)] == 0 &&
                   is_inside(x, y, static_cast<int>(pixel_error) + 2);
      }
      if (holes > 0) say(fmt::format("{} pixels show through at a pixel error of {}", holes, pixel_error));
    }
  }

  /// Frame 2 is the first whose predecessor was coherent.
  void expect_rest(const FrameRecord& record, const std::vector<uint8_t>& picture) {
    if (record.visible != last_ || record.added + record.removed > 0) say("the visible set does not rest");
    if (picture != last_picture_) say("the picture flickers");
  }

  const Trial& trial_;
  const DeviceKind device_kind_;
  BuiltTrial built_;
  const PackObjects objects_ = built_.pack().read_objects();
  std::optional<BuiltTrial> built_twin_;
  LocalPipeline culled_, whole_, everything_, portals_, unbounded_, with_backs_, items_, sampled_,
      sampled_whole_;
  std::optional<LocalPipeline> twin_;
  size_t frame_ = 0, shown_ = 0;
  VisibleSet last_;
  std::vector<uint8_t> last_picture_;
  Problems problems_;
};

}  // namespace

Problems picture_problems(const Trial& trial, const DeviceOptions& device) {
  return trial.views.empty() ? Problems() : PictureTrial(trial, device).run();
}

}  // namespace triptych::hard_cases
