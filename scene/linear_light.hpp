// Between colours as displayed (sRGB, bytes) and linear light (whole numbers to 65,535): by tables that are
// the same on every processor, since only sums, products and quotients make them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

namespace triptych {

class LinearLight {
 public:
  static constexpr uint32_t most = 65535;

  /// Made when it is first asked for.
  static const LinearLight& table();

  uint16_t of(uint8_t displayed) const { return linear_[displayed]; }
  /// The nearest byte. linear: at most `most`.
  uint8_t displayed(uint32_t linear) const { return displayed_[linear]; }

 private:
  LinearLight();
  std::array<uint16_t, 256> linear_;
  std::unique_ptr<uint8_t[]> displayed_;
};

}  // namespace triptych
