// Records a target's answers and plays them back: the same frames without the device that drew them.
#pragma once

#include "visibility/frame_target.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// The answers of tests in their order, one per test.
struct AnswerLog {
  std::vector<uint8_t> answers;
  DeviceMargins margins;  ///< of who gave them
};

/// Forwards everything to a target, and records its answers.
class AnswerRecorder final : public FrameTarget {
 public:
  AnswerRecorder(FrameTarget& target, AnswerLog& log) : target_(target), log_(log) {
    log_.margins = target.margins();
  }
  int width() const override { return target_.width(); }
  int height() const override { return target_.height(); }
  TargetKind kind() const override { return target_.kind(); }
  DeviceMargins margins() const override { return target_.margins(); }
  void begin(const FrameView& view) override { target_.begin(view); }
  void draw(std::span<const DrawableId> drawables) override { target_.draw(drawables); }
  void test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends, uint32_t min_pixels,
            std::span<uint8_t> visible) override;
  void finish() override { target_.finish(); }
  uint64_t drawn_triangles() const override { return target_.drawn_triangles(); }
  void draw_lines(std::span<const ScreenLine> lines) override { target_.draw_lines(lines); }
  std::vector<uint8_t> read_colors() const override { return target_.read_colors(); }
  std::vector<uint32_t> read_items(uint32_t sample) const override { return target_.read_items(sample); }
  std::span<const uint8_t> colors_in_memory() const override { return target_.colors_in_memory(); }
  bool copy_to_window(int width, int height) const override { return target_.copy_to_window(width, height); }

 private:
  FrameTarget& target_;
  AnswerLog& log_;
};

/// Draws nothing, and gives the recorded answers. Error (place: answer log) if more are requested.
class AnswerPlayer final : public FrameTarget {
 public:
  AnswerPlayer(const AnswerLog& log, int width, int height) : log_(log), width_(width), height_(height) {}
  /// Starts again with the first answer.
  void rewind() { next_ = 0; }
  int width() const override { return width_; }
  int height() const override { return height_; }
  TargetKind kind() const override { return TargetKind::depth_only; }
  DeviceMargins margins() const override { return log_.margins; }
  void begin(const FrameView&) override {}
  void draw(std::span<const DrawableId>) override {}
  void test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends, uint32_t min_pixels,
            std::span<uint8_t> visible) override;
  void finish() override {}
  uint64_t drawn_triangles() const override { return 0; }
  void draw_lines(std::span<const ScreenLine>) override {}
  std::vector<uint8_t> read_colors() const override { return {}; }
  std::vector<uint32_t> read_items(uint32_t) const override { return {}; }
  bool copy_to_window(int, int) const override { return false; }

 private:
  const AnswerLog& log_;
  int width_, height_;
  size_t next_ = 0;
};

}  // namespace triptych
