// The seam to a way of drawing a frame whose speed is measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// One part of a frame, wall-clock milliseconds.
struct SpeedStage {
  std::string name;
  double milliseconds = 0;
};

/// Draws frames of one path. It keeps a reference to them: a frame is named by its place there.
class SpeedMethod {
 public:
  virtual ~SpeedMethod() = default;

  /// As `method` in reports.
  virtual std::string name() const = 0;
  /// The device that draws; empty where none does.
  virtual std::string device() const = 0;
  /// What is not timed; comes before each draw().
  virtual void prepare(size_t /*frame*/) {}
  /// Draws the frame, and returns when its picture stands.
  virtual void draw(size_t frame) = 0;
  /// Of the last frame.
  virtual std::vector<SpeedStage> stages() const = 0;
  virtual uint64_t drawn_triangles() const = 0;
};

}  // namespace triptych
