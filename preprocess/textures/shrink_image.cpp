#include "base/bytes.hpp"
#include "preprocess/textures/image.hpp"
#include "scene/linear_light.hpp"

#include <algorithm>
#include <array>
#include <meshoptimizer.h>

namespace triptych {

namespace {

/// The texels of a row or a column that one texel of the smaller image stands for, and how much of each: of
/// their size, `size` parts.
struct Covered {
  uint32_t first, last, size, of_first, of_last;
  uint32_t weight(uint32_t i) const { return i == first ? of_first : i == last ? of_last : size; }
};

Covered covered_by(uint32_t index, uint32_t from, uint32_t to) {
  // In parts of a texel: it covers from · index up to from · (index + 1), of texels of `to` parts each.
  const uint64_t begin = uint64_t{from} * index, end = begin + from;
  const auto first = static_cast<uint32_t>(begin / to), last = static_cast<uint32_t>((end - 1) / to);
  const auto of_first = static_cast<uint32_t>(std::min<uint64_t>(end, (uint64_t{first} + 1) * to) - begin);
  return {first, last, to, of_first, static_cast<uint32_t>(end - std::max(begin, uint64_t{last} * to))};
}

}  // namespace

Image half_of(const Image& image) {
  const LinearLight& light = LinearLight::table();
  Image half{side_at_level(image.width, 1), side_at_level(image.height, 1), {}};
  half.texels.reserve(size_t{half.width} * half.height);
  for (uint32_t y = 0; y < half.height; ++y) {
    const Covered rows = covered_by(y, image.height, half.height);
    for (uint32_t x = 0; x < half.width; ++x) {
      const Covered columns = covered_by(x, image.width, half.width);
      uint64_t weights = 0, alphas = 0;
      std::array<uint64_t, 3> covered = {}, all = {};
      for (uint32_t row = rows.first; row <= rows.last; ++row) {
        for (uint32_t column = columns.first; column <= columns.last; ++column) {
          const Texel& texel = image.texels[size_t{row} * image.width + column];
          const uint64_t weight = uint64_t{rows.weight(row)} * columns.weight(column);
          weights += weight;
          alphas += weight * texel[3];
          for (size_t k = 0; k < 3; ++k) {
            covered[k] += weight * texel[3] * light.of(texel[k]);
            all[k] += weight * light.of(texel[k]);
          }
        }
      }
      Texel& texel = half.texels.emplace_back();
      texel[3] = static_cast<uint8_t>((alphas + weights / 2) / weights);
      for (size_t k = 0; k < 3; ++k) {
        const uint64_t mean = alphas > 0 ? covered[k] / alphas : all[k] / weights;
        texel[k] = light.displayed(static_cast<uint32_t>(mean));
      }
    }
  }
  return half;
}

void keep_covered(Image& image, const Image& of, uint8_t cutoff) {
  const auto count_alphas = [](const Image& counted) {
    std::array<uint64_t, 256> counts = {};
    for (const Texel& texel : counted.texels) ++counts[texel[3]];
    return counts;
  };
  const auto before = count_alphas(of), own = count_alphas(image);
  uint64_t covered = 0;
  for (size_t alpha = cutoff; alpha < before.size(); ++alpha) covered += before[alpha];
  // The alpha that as large a share has here, at least.
  size_t least = own.size() - 1;
  for (uint64_t here = own[least]; least > 1 && here * of.texels.size() < covered * image.texels.size();)
    here += own[--least];
  for (Texel& texel : image.texels)
    texel[3] = static_cast<uint8_t>(std::min<size_t>(255, (texel[3] * size_t{cutoff} + least - 1) / least));
}

std::vector<std::byte> encode_texels(const Image& image) {
  const size_t count = image.texels.size();
  std::vector<std::byte> bytes(meshopt_encodeVertexBufferBound(count, sizeof(Texel)));
  bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                          image.texels.data(), count, sizeof(Texel)));
  return bytes;
}

}  // namespace triptych
