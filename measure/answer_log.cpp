#include "measure/answer_log.hpp"

#include "base/error.hpp"

#include <algorithm>

namespace triptych {

void AnswerRecorder::test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends,
                          uint32_t min_pixels, std::span<uint8_t> visible) {
  target_.test(rectangles, ends, min_pixels, visible);
  log_.answers.insert(log_.answers.end(), visible.begin(), visible.end());
}

void AnswerPlayer::test(std::span<const ScreenRectangle>, std::span<const uint32_t>, uint32_t,
                        std::span<uint8_t> visible) {
  if (visible.size() > log_.answers.size() - next_)
    fail("answer log", "{} answers are asked for, {} are left", visible.size(), log_.answers.size() - next_);
  std::copy_n(log_.answers.begin() + static_cast<std::ptrdiff_t>(next_), visible.size(), visible.begin());
  next_ += visible.size();
}

}  // namespace triptych
