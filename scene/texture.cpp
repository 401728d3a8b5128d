#include "scene/texture.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <meshoptimizer.h>

namespace triptych {

TextureCoordinates texture_coordinates(double u, double v) {
  const auto fixed = [](double value) {
    constexpr double most = 32000;
    const double within = value >= -most ? std::min(value, most) : -most;
    return static_cast<int32_t>(std::llrint(within * TextureCoordinates::unit));
  };
  return {fixed(u), fixed(v)};
}

std::vector<Texel> decode_texels(std::span<const std::byte> bytes, uint32_t width, uint32_t height,
                                 const std::string& place) {
  std::vector<Texel> texels(size_t{width} * height);
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  if (meshopt_decodeVertexBuffer(texels.data(), texels.size(), sizeof(Texel), data, bytes.size()) != 0)
    fail(place, "does not decode");
  return texels;
}

}  // namespace triptych
