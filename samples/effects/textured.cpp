#include "samples/effects/textured.hpp"

#include "samples/image_file.hpp"
#include "samples/solids.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

constexpr const char *carpet_image = "carpet.png", *fence_image = "fence.png", *sign_image = "sign.png";

/// A rectangle in the plane z = 0, from the origin on, over so many repetitions of an image.
MeshPart sheet(double width, double tall, double repeats_x, double repeats_y) {
  MeshPart part;
  for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
    part.positions.emplace_back(u * width, v * tall, 0);
    part.texture_places.emplace_back(u * repeats_x, (1 - v) * repeats_y);
  }
  part.indices = {0, 1, 2, 0, 2, 3};
  return part;
}

}  // namespace

void write_effect_images(const std::filesystem::path& folder) {
  constexpr uint32_t side = 256;
  write_image_file(folder / carpet_image, side, side, [](uint32_t x, uint32_t y) -> ImagePixel {
    const bool stripe = (x / 16 + y / 16) % 2 == 0, rim = x < 8 || y < 8;
    const auto grain = static_cast<uint8_t>((x * 37 + y * 91) % 32);
    if (rim) return {230, 200, 90, 255};
    return stripe ? ImagePixel{static_cast<uint8_t>(140 + grain), 30, 40, 255}
                  : ImagePixel{30, 60, static_cast<uint8_t>(110 + grain), 255};
  });
  write_image_file(folder / fence_image, side, side, [](uint32_t x, uint32_t y) -> ImagePixel {
    constexpr uint32_t mesh = 64, wire = 7;
    const bool is_wire = (x + y) % mesh < wire || (x + side - y) % mesh < wire || y < 2 * wire;
    return {90, 110, 95, static_cast<uint8_t>(is_wire ? 255 : 0)};
  });
  write_image_file(folder / sign_image, side, side, [](uint32_t x, uint32_t y) -> ImagePixel {
    const double across = x / 256.0 - 0.5, down = y / 256.0 - 0.5;
    const double ring = std::abs(std::hypot(across, down) - 0.35), bar = std::abs(across - down);
    const bool bright = ring < 0.05 || (bar < 0.05 && std::hypot(across, down) < 0.35);
    return bright ? ImagePixel{255, 90, 30, 255} : ImagePixel{8, 8, 10, 255};
  });
}

MeshPart carpet(bool textured) {
  constexpr int columns = 60, rows = 12;
  constexpr double width = 6, deep = 1.2, repeats = 6;
  MeshPart part;
  part.colour = textured ? glm::dvec3(1) : glm::dvec3(0.3, 0.06, 0.1);
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const double u = column / double{columns}, v = row / double{rows};
      part.positions.emplace_back((u - 0.5) * width, 0.012 + 0.01 * std::sin(9 * u) * std::cos(5 * v),
                                  (v - 0.5) * deep);
      part.texture_places.emplace_back(u * repeats, v * repeats * deep / width);
    }
  }
  constexpr uint32_t stride = columns + 1;
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t column = 0; column < columns; ++column) {
      const uint32_t first = row * stride + column;
      for (const uint32_t corner :
           {first, first + stride, first + stride + 1, first, first + stride + 1, first + 1})
        part.indices.push_back(corner);
    }
  }
  if (textured) {
    part.texture = carpet_image;
  } else {
    part.texture_places.clear();
  }
  return part;
}

MeshPart fence(bool textured) {
  MeshPart part = sheet(4, 1, 8, 2);
  part.colour = textured ? glm::dvec3(1) : glm::dvec3(0.1, 0.15, 0.12);
  part.cut_out = textured;
  if (textured) {
    part.texture = fence_image;
  } else {
    part.texture_places.clear();
  }
  return part;
}

std::vector<MeshPart> lamp(bool textured, bool emissive) {
  MeshPart tube = box({-0.5, 2.2, -0.03}, {0.5, 2.26, 0.03}, {0.3, 0.3, 0.28});
  MeshPart sign = sheet(0.6, 0.6, 1, 1);
  for (glm::vec3& position : sign.positions) position += glm::vec3(-0.3, 1.4, 0);
  sign.colour = glm::dvec3(0.05);
  if (emissive) {
    tube.emission = {1, 0.9, 0.6};
    sign.emission = glm::dvec3(1);
  }
  if (textured && emissive) {
    sign.emission_texture = sign_image;
  } else {
    sign.texture_places.clear();
  }
  return {tube, sign};
}

}  // namespace triptych
