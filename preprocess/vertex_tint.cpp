#include "preprocess/vertex_tint.hpp"

#include "model/import/display_color.hpp"

namespace triptych {

namespace {

std::array<double, 256> make_linear_values() {
  std::array<double, 256> values;
  for (size_t i = 0; i < values.size(); ++i) values[i] = linear_from_display(static_cast<double>(i) / 255);
  return values;
}

}  // namespace

VertexTint::VertexTint(std::span<const Material> materials) {
  for (const Material& material : materials) {
    const glm::vec4& base = material.base_color;
    const VertexColor own = {display_byte(base.r), display_byte(base.g), display_byte(base.b), 255};
    const bool first = tints_.empty();
    tints_.push_back({first ? glm::vec3(1) : glm::vec3(base), own});
  }
}

CornerColors VertexTint::operator()(const CornerColors& corners, uint32_t material) const {
  static const std::array<double, 256> linear = make_linear_values();
  const Tint tint = material < tints_.size() ? tints_[material] : Tint();
  CornerColors drawn = corners;
  for (VertexColor& color : drawn) {
    if (!is_colored(color)) {
      color = tint.own;
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

}  // namespace triptych
