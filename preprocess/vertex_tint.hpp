// What vertex colours are drawn as: multiplied by the base colours of the materials.
#pragma once

#include "model/model.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace triptych {

/// Red, green and blue as displayed (sRGB), and alpha.
using DisplayColor = std::array<uint8_t, 4>;

/// A material's base colour without any texture.
DisplayColor display_color(const Material& material);

class VertexTint {
 public:
  /// Of white materials.
  VertexTint() = default;
  /// Material 0 stands for none, and leaves vertex colours as they are.
  explicit VertexTint(std::span<const Material> materials);

  /// Colours of corners (Mesh::colors) as they are drawn: times the material's base colour in linear light; a
  /// corner without a colour has the material's.
  CornerColors operator()(const CornerColors& corners, uint32_t material) const;
  /// The same with the material's alpha, if it is one colour at all three corners.
  std::optional<DisplayColor> flat(const CornerColors& corners, uint32_t material) const;

 private:
  struct Tint {
    glm::vec3 factor{1};  ///< linear
    DisplayColor own{255, 255, 255, 255};
  };
  std::vector<Tint> tints_;  ///< by material; beyond: white
};

}  // namespace triptych
