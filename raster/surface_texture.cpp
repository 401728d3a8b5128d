#include "raster/surface_texture.hpp"

#include "scene/linear_light.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

constexpr uint32_t one = 256;  ///< of shares

int64_t wrapped(int64_t index, int64_t size, TextureWrap wrap) {
  if (index >= 0 && index < size) return index;
  if (wrap == TextureWrap::clamp) return std::clamp<int64_t>(index, 0, size - 1);
  const int64_t period = wrap == TextureWrap::repeat ? size : 2 * size;
  const int64_t within = (index % period + period) % period;
  return within < size ? within : 2 * size - 1 - within;
}

/// Two texels side by side, and the share of the second.
struct Between {
  size_t first, second;
  uint32_t share;
};

/// along: in sizes of the texture.
Between between(double along, uint32_t size, TextureWrap wrap, bool nearest) {
  const auto index = [&](int64_t i) { return static_cast<size_t>(wrapped(i, size, wrap)); };
  if (nearest) {
    const size_t own = index(static_cast<int64_t>(std::floor(along * size)));
    return {own, own, 0};
  }
  const double at = along * size - 0.5, below = std::floor(at);
  const auto i = static_cast<int64_t>(below);
  return {index(i), index(i + 1), static_cast<uint32_t>((at - below) * one)};
}

/// Times one².
TextureSample sample_level(const TextureLevels& levels, uint32_t texture, uint32_t level,
                           const TextureSampler& sampler, const TexturePlace& place,
                           TextureSampling sampling) {
  const bool is_color = sampling == TextureSampling::colors;
  if (is_color) level = levels.shown(texture, level);
  const LinearLight& light = LinearLight::table();
  const Texture& own = levels.texture(texture);
  const uint32_t width = side_at_level(own.width, level), height = side_at_level(own.height, level);
  const Between x = between(place.u, width, sampler.wrap_u, sampler.nearest),
                y = between(place.v, height, sampler.wrap_v, sampler.nearest);
  const Texel* const texels =
      is_color ? levels.texels_within_cap(texture, level) : levels.texels(texture, level);
  if (texels == nullptr) return {0, 0, 0, 0};  // the picture is made again
  uint64_t sums[4] = {0, 0, 0, 0};
  const auto add = [&](size_t column, size_t row, uint32_t share) {
    const Texel& texel = texels[row * width + column];
    for (size_t k = 0; k < 3; ++k) sums[k] += uint64_t{share} * light.of(texel[k]);
    sums[3] += uint64_t{share} * texel[3] * one;
  };
  add(x.first, y.first, (one - x.share) * (one - y.share));
  add(x.second, y.first, x.share * (one - y.share));
  add(x.first, y.second, (one - x.share) * y.share);
  add(x.second, y.second, x.share * y.share);
  const auto rounded = [](uint64_t sum) {
    return static_cast<uint32_t>((sum + one * one / 2) / (one * one));
  };
  return {rounded(sums[0]), rounded(sums[1]), rounded(sums[2]), rounded(sums[3])};
}

/// The binary logarithm, but between powers of two as if it grew evenly there, which it nearly does.
double about_log2(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);  // 0.5 up to 1
  return (exponent - 1) + (2 * mantissa - 1);
}

}  // namespace

TextureSample sample(const TextureLevels& levels, uint32_t texture, const TextureSampler& sampler,
                     const TexturePlace& place, TextureSampling sampling) {
  const Texture& own = levels.texture(texture);
  const double right_x = place.right_u * own.width, right_y = place.right_v * own.height,
               up_x = place.up_u * own.width, up_y = place.up_v * own.height;
  const double squared = std::max(right_x * right_x + right_y * right_y, up_x * up_x + up_y * up_y);
  const auto last = static_cast<uint32_t>(own.levels.size() - 1);
  constexpr double huge = 1e30;
  if (!(squared < huge)) return sample_level(levels, texture, last, sampler, place, sampling);
  const double level = squared > 1 ? about_log2(squared) / 2 : 0;
  const auto finer = static_cast<uint32_t>(level);
  if (finer >= last) return sample_level(levels, texture, last, sampler, place, sampling);
  const auto share = static_cast<uint32_t>((level - finer) * one);
  const TextureSample fine = sample_level(levels, texture, finer, sampler, place, sampling);
  if (share == 0) return fine;
  const TextureSample coarse = sample_level(levels, texture, finer + 1, sampler, place, sampling);
  const auto mix = [&](uint32_t a, uint32_t b) { return (a * (one - share) + b * share + one / 2) / one; };
  return {mix(fine.red, coarse.red), mix(fine.green, coarse.green), mix(fine.blue, coarse.blue),
          mix(fine.alpha, coarse.alpha)};
}

TexturePlace SurfaceTexture::at(double x, double y) const {
  double own[3];
  const double sum = weights.clamped_at(x, y, own);
  TexturePlace place;
  const auto mixed = [&](const double(&of)[3]) {
    return sum > 0 ? ((own[0] * of[0] + own[1] * of[1]) + own[2] * of[2]) / sum : of[0];
  };
  place.u = mixed(u);
  place.v = mixed(v);
  weights.change(x, y, u, place.u, place.right_u, place.up_u);
  weights.change(x, y, v, place.v, place.right_v, place.up_v);
  return place;
}

bool SurfaceTexture::is_solid(const TextureLevels& levels, double x, double y) const {
  return sample(levels, material->texture, material->sampler, at(x, y), TextureSampling::holes).alpha >=
         uint32_t{material->cutoff} * one;
}

SurfaceTexture surface_texture(const VertexStage& stage, int width, int height, const PlacedLattice& placed,
                               const RasterChunk& chunk, uint32_t triangle, const SurfaceMaterial& material) {
  SurfaceTexture surface;
  surface.weights = perspective_weights(stage, width, height, placed, chunk, triangle);
  surface.material = &material;
  for (size_t i = 0; i < 3; ++i) {
    const TextureCoordinates& place = chunk.coordinates[chunk.corner[i][triangle]];
    surface.u[i] = is_on_texture(place) ? static_cast<double>(place.u) / TextureCoordinates::unit : 0;
    surface.v[i] = is_on_texture(place) ? static_cast<double>(place.v) / TextureCoordinates::unit : 0;
  }
  return surface;
}

}  // namespace triptych
