// AutoCAD's colours.
#include "model/import/import_dxf.hpp"

#include <algorithm>
#include <cmath>

namespace triptych::dxf_color {

namespace {

uint32_t packed(double red, double green, double blue) {
  const auto byte = [](double value) { return static_cast<uint32_t>(std::clamp(value, 0.0, 255.0)); };
  return byte(red) << 16 | byte(green) << 8 | byte(blue);
}

/// 10 to 249: 24 hues, from each five values, which are full at even numbers and half grey at odd ones.
uint32_t of_wheel(int64_t index) {
  static constexpr std::array<double, 5> values = {255, 165, 127, 76, 38};
  const int64_t step = index % 10;
  const double value = values[static_cast<size_t>(step / 2)];
  const double least = step % 2 == 0 ? 0 : std::floor(value / 2);
  const double hue = static_cast<double>(index / 10 - 1) / 4;  // 0 to 6, red, yellow, green ...
  const auto channel = [&](double full_at) {
    double distance = std::abs(hue - full_at);
    distance = std::min(distance, 6 - distance);
    return least + (value - least) * std::clamp(2 - distance, 0.0, 1.0);
  };
  return packed(channel(0), channel(2), channel(4));
}

}  // namespace

DxfColor of_index(int64_t index) {
  static constexpr std::array<uint32_t, 10> first = {0xffffff, 0xff0000, 0xffff00, 0x00ff00, 0x00ffff,
                                                     0x0000ff, 0xff00ff, 0xffffff, 0x808080, 0xc0c0c0};
  static constexpr std::array<uint32_t, 6> grey = {0x333333, 0x505050, 0x696969,
                                                   0x828282, 0xbebebe, 0xffffff};
  index = std::abs(index);
  if (index > 255) return by_layer;
  if (index >= 250) return grey[static_cast<size_t>(index - 250)];
  return index < 10 ? first[static_cast<size_t>(index)] : of_wheel(index);
}

DxfColor of_record(const DxfRecord& record) {
  if (record.has(420)) return static_cast<uint32_t>(record.integer(420)) & 0xffffffu;
  const int64_t index = record.integer(62, 256);
  return index == 256 ? by_layer : index == 0 ? by_block : of_index(index);
}

}  // namespace triptych::dxf_color
