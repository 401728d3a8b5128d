// A perceptual difference of pictures, by libjxl's program `butteraugli_main` (Debian: libjxl-devtools).
#pragma once

#include <filesystem>
#include <optional>

namespace triptych {

class Butteraugli {
 public:
  /// Nullopt where the program is not installed.
  static std::optional<Butteraugli> find();

  /// How far two PNG files of one size are apart to the eye: the 3-norm of the distance map; 0 for equal
  /// ones. Error (the program) where it fails.
  double distance(const std::filesystem::path& reference, const std::filesystem::path& shown) const;

  static constexpr const char* package = "libjxl-devtools";

 private:
  explicit Butteraugli(std::filesystem::path program) : program_(std::move(program)) {}
  std::filesystem::path program_;
};

}  // namespace triptych
