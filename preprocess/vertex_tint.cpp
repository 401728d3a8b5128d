#include "preprocess/vertex_tint.hpp"

#include "model/import/display_color.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

std::array<double, 256> make_linear_values() {
  std::array<double, 256> values;
  for (size_t i = 0; i < values.size(); ++i) values[i] = linear_from_display(static_cast<double>(i) / 255);
  return values;
}

}  // namespace

DisplayColor display_color(const Material& material) {
  const glm::vec4& factor = material.base_color;
  return {display_byte(factor.r), display_byte(factor.g), display_byte(factor.b),
          static_cast<uint8_t>(std::lround(std::clamp(factor.a, 0.0f, 1.0f) * 255))};
}

VertexTint::VertexTint(std::span<const Material> materials) {
  for (const Material& material : materials) {
    const bool first = tints_.empty();
    tints_.push_back({first ? glm::vec3(1) : glm::vec3(material.base_color), display_color(material)});
  }
}

CornerColors VertexTint::operator()(const CornerColors& corners, uint32_t material) const {
  static const std::array<double, 256> linear = make_linear_values();
  const Tint tint = material < tints_.size() ? tints_[material] : Tint();
  CornerColors drawn = corners;
  for (VertexColor& color : drawn) {
    if (!is_colored(color)) {
      color = {tint.own[0], tint.own[1], tint.own[2], 255};
      continue;
    }
    for (int channel = 0; channel < 3; ++channel) {
      uint8_t& value = color[static_cast<size_t>(channel)];
      const float factor = tint.factor[channel];
      if (factor != 1) value = display_byte(linear[value] * static_cast<double>(factor));
    }
  }
  return drawn;
}

std::optional<DisplayColor> VertexTint::flat(const CornerColors& corners, uint32_t material) const {
  const CornerColors drawn = (*this)(corners, material);
  if (drawn[0] != drawn[1] || drawn[0] != drawn[2]) return std::nullopt;
  const uint8_t alpha = material < tints_.size() ? tints_[material].own[3] : 255;
  return DisplayColor{drawn[0][0], drawn[0][1], drawn[0][2], alpha};
}

}  // namespace triptych
