// Puts a case to the test: every function returns what is wrong, in words; nothing where all is well.
#pragma once

#include "nodes/device_choice.hpp"
#include "scene/pack.hpp"
#include "tests/hard_cases/hard_case.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace triptych::hard_cases {

using Problems = std::vector<std::string>;

/// A trial's pack, built into a file of its own that goes with it.
class BuiltTrial {
 public:
  explicit BuiltTrial(const Trial& trial);
  ~BuiltTrial();
  BuiltTrial(const BuiltTrial&) = delete;
  BuiltTrial& operator=(const BuiltTrial&) = delete;
  const Pack& pack() const { return *pack_; }
  const std::filesystem::path& file() const { return file_; }
  const BuildReport& report() const { return report_; }

 private:
  std::filesystem::path file_;
  BuildReport report_;
  std::unique_ptr<Pack> pack_;
};

/// The build itself: `check`'s invariants, errors against the model as it was given, orientation, counts.
Problems build_problems(const Trial& trial);
/// Cuts: everything in the frustum is covered, and no point of a chosen surface can move further on the
/// screen than the pixel error, in long double and by sampling.
Problems cut_problems(const Trial& trial);
/// Pictures of every frame: culled, un-culled, of the whole model and of the twin are equal pixel for pixel;
/// every drawable that owns a pixel is in the visible set. device: a chosen one.
Problems picture_problems(const Trial& trial, const DeviceOptions& device);
/// The real program in three processes, in a folder of its own: `triptych measure session`, or, where paths
/// must be refused, what it says to them.
Problems session_problems(const Trial& trial, const std::vector<std::string>& faults = {});

}  // namespace triptych::hard_cases
