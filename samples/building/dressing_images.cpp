#include "samples/building/dressing_images.hpp"

#include "base/file.hpp"
#include "base/threads.hpp"
#include "samples/image_file.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <functional>
#include <glm/glm.hpp>

namespace triptych {

namespace {

/// 0 up to 1, for each pair of whole numbers another one.
double hashed(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ seed * 0xc2b2ae3du;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<double>((h ^ (h >> 15)) >> 8) * 0x1p-24;
}

/// Smooth noise, 0 to 1, that repeats after so many cells.
double noise(double x, double y, uint32_t cells_x, uint32_t cells_y, uint32_t seed) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const double sx = smooth(x - fx), sy = smooth(y - fy);
  const auto at = [&](int dx, int dy) {
    return hashed(static_cast<uint32_t>(static_cast<int64_t>(fx) + dx) % cells_x,
                  static_cast<uint32_t>(static_cast<int64_t>(fy) + dy) % cells_y, seed);
  };
  return (at(0, 0) * (1 - sx) + at(1, 0) * sx) * (1 - sy) + (at(0, 1) * (1 - sx) + at(1, 1) * sx) * sy;
}

ImagePixel pixel(const glm::dvec3& color, double alpha = 1) {
  const auto byte = [](double value) {
    return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
  };
  return {byte(color.r), byte(color.g), byte(color.b), byte(alpha)};
}

/// Eight rows of planks, each with joints of its own.
ImagePixel plank(uint32_t x, uint32_t y, uint32_t side) {
  const uint32_t tall = side / 8, row = y / tall, down = y % tall;
  const auto shift = static_cast<uint32_t>(hashed(row, 0, 11) * side);
  const uint32_t along = (x + shift) % side, board = along / (side / 2), within = along % (side / 2);
  const double tone = 0.82 + 0.30 * hashed(row, board, 12);
  const double u = x / static_cast<double>(side), v = y / static_cast<double>(side);
  const double grain = noise(8 * u + 3 * hashed(row, board, 13), 128 * v, 8, 128, 14) * 0.6 +
                       noise(24 * u, 256 * v, 24, 256, 15) * 0.4;
  glm::dvec3 color = glm::dvec3(0.66, 0.49, 0.31) * tone * (0.84 + 0.26 * grain);
  if (down < 2 || within < 2) color *= 0.55;
  return pixel(color);
}

ImagePixel carpet_pixel(uint32_t x, uint32_t y) {
  const double loop = hashed(x / 2, y / 2, 21), patch = noise(x / 32.0, y / 32.0, 16, 16, 22);
  return pixel(glm::dvec3(0.72 + 0.22 * loop + 0.08 * patch));
}

ImagePixel tile_pixel(uint32_t x, uint32_t y, uint32_t side) {
  const uint32_t tile = side / 2, in_x = x % tile, in_y = y % tile;
  if (in_x < 4 || in_y < 4) return pixel({0.58, 0.57, 0.55});
  const double tone = 0.95 + 0.05 * hashed(x / tile, y / tile, 31);
  const double cloud = noise(x / 24.0, y / 24.0, side / 24 + 1, side / 24 + 1, 32);
  const double bevel = in_x < 7 || in_y < 7 ? 1.04 : in_x > tile - 4 || in_y > tile - 4 ? 0.93 : 1;
  return pixel(glm::dvec3(0.86, 0.86, 0.84) * tone * bevel * (0.96 + 0.05 * cloud));
}

/// Chips of stone in cement: the nearest of points in cells says which.
ImagePixel terrazzo_pixel(uint32_t x, uint32_t y, uint32_t side) {
  constexpr int cells = 32;
  const double u = x * double{cells} / side, v = y * double{cells} / side;
  double nearest = 9, chip = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int cx = static_cast<int>(u) + dx, cy = static_cast<int>(v) + dy;
      const auto wx = static_cast<uint32_t>((cx + cells) % cells),
                 wy = static_cast<uint32_t>((cy + cells) % cells);
      const double px = cx + hashed(wx, wy, 41), py = cy + hashed(wx, wy, 42);
      const double far = std::hypot(u - px, v - py) / (0.5 + hashed(wx, wy, 43));
      if (far < nearest) nearest = far, chip = hashed(wx, wy, 44);
    }
  }
  const glm::dvec3 cement(0.70, 0.68, 0.64);
  if (nearest > 0.42) return pixel(cement * (0.96 + 0.06 * hashed(x, y, 45)));
  const glm::dvec3 stones[] = {
      {0.56, 0.53, 0.50}, {0.80, 0.77, 0.72}, {0.64, 0.55, 0.48}, {0.60, 0.61, 0.58}};
  return pixel(stones[static_cast<size_t>(chip * 4)]);
}

ImagePixel panel_pixel(uint32_t x, uint32_t y, uint32_t side) {
  const uint32_t panel = side / 2, in_x = x % panel, in_y = y % panel;
  if (in_x < 5 || in_y < 5) return pixel(in_x < 2 || in_y < 2 ? glm::dvec3(0.72) : glm::dvec3(0.88));
  const bool hole = in_x % 10 > 7 && in_y % 10 > 7 && hashed(in_x / 10, in_y / 10, 51) < 0.85;
  return pixel(hole ? glm::dvec3(0.80) : glm::dvec3(0.95 + 0.03 * hashed(x, y, 52)));
}

ImagePixel brick_pixel(uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
  const uint32_t tall = height / 8, row = y / tall, long_side = width / 4;
  const uint32_t along = (x + (row % 2) * long_side / 2) % width, in_x = along % long_side, in_y = y % tall;
  if (in_x < 5 || in_y < 5) return pixel(glm::dvec3(0.66, 0.62, 0.57) * (0.94 + 0.1 * hashed(x, y, 61)));
  const double tone = 0.80 + 0.34 * hashed(along / long_side, row, 62);
  const double rough = noise(x / 4.0, y / 4.0, width / 4, height / 4, 63);
  return pixel(glm::dvec3(0.62, 0.36, 0.27) * tone * (0.90 + 0.16 * rough));
}

/// A frame around two panels.
ImagePixel door_pixel(uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
  const double u = x / static_cast<double>(width), v = y / static_cast<double>(height);
  const double grain = noise(64 * u, 6 * v, 64, 6, 71) * 0.6 + noise(160 * u, 20 * v, 160, 20, 72) * 0.4;
  glm::dvec3 color = glm::dvec3(0.56, 0.38, 0.23) * (0.82 + 0.32 * grain);
  const auto near = [](double at, double edge) { return std::abs(at - edge) < 0.012; };
  const bool across = u > 0.16 && u < 0.84;
  for (const auto& [from, to] : {std::pair(0.08, 0.46), {0.54, 0.92}}) {
    if (across && (near(v, from) || near(v, to))) color *= 0.6;
    if (v > from && v < to && (near(u, 0.16) || near(u, 0.84))) color *= 0.6;
  }
  return pixel(color);
}

ImagePixel grass_pixel(uint32_t x, uint32_t y) {
  const double blade = hashed(x, y / 3, 81), patch = noise(x / 64.0, y / 64.0, 8, 8, 82),
               tuft = noise(x / 8.0, y / 8.0, 64, 64, 83);
  return pixel(glm::mix(glm::dvec3(0.30, 0.43, 0.16), glm::dvec3(0.47, 0.56, 0.24),
                        0.35 * blade + 0.3 * tuft + 0.35 * patch));
}

/// Threads with gaps between them, bands without, and a hem.
ImagePixel curtain_pixel(uint32_t x, uint32_t y, uint32_t height) {
  const bool hem = y < height / 16 || y > height - height / 12, band = x % 64 < 12;
  const bool thread = x % 8 < 3 || y % 8 < 3;
  const uint32_t in_x = x % 64, in_y = y % 64;
  const double flower = std::hypot(in_x - 38.0, in_y - 32.0);
  const bool shows = hem || band || thread || flower < 9 || (flower > 13 && flower < 16);
  const double tone = 0.90 + 0.08 * hashed(x, y, 91);
  return pixel(glm::dvec3(0.96, 0.93, 0.86) * tone, shows ? 1 : 0);
}

ImagePixel blind_pixel(uint32_t x, uint32_t y, uint32_t width) {
  const uint32_t in_y = y % 16;
  const bool string = x % (width / 3) > width / 6 && x % (width / 3) < width / 6 + 3;
  const double tone = 0.95 - 0.03 * in_y;
  return pixel(glm::dvec3(0.90, 0.89, 0.85) * tone, in_y < 11 || string ? 1 : 0);
}

/// Hills under a sky; circles; fields between black lines.
ImagePixel picture_pixel(int number, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
  const auto seed = static_cast<uint32_t>(1000 + number);
  const double u = x / static_cast<double>(width), v = y / static_cast<double>(height);
  const auto any_color = [&](uint32_t of) {
    return glm::dvec3(hashed(of, 1, seed), hashed(of, 2, seed), hashed(of, 3, seed));
  };
  const double canvas = 0.96 + 0.06 * hashed(x / 2, y / 2, 99);
  if (number % 3 == 0) {
    glm::dvec3 color = glm::mix(glm::dvec3(0.95, 0.80, 0.62), glm::dvec3(0.42, 0.62, 0.85), 1 - v);
    const double sun = std::hypot((u - 0.3 - 0.4 * hashed(0, 0, seed)) * 1.33, v - 0.3);
    if (sun < 0.07) color = {1.0, 0.93, 0.75};
    for (uint32_t hill = 0; hill < 4; ++hill) {
      const double top = 0.42 + 0.14 * hill - 0.16 * noise(3.0 * u + 7 * hill, 0.5, 64, 4, seed + hill) -
                         0.03 * noise(24 * u, 0.5, 64, 4, seed + 9 + hill);
      if (v > top)
        color = glm::mix(glm::dvec3(0.50, 0.58, 0.66), glm::dvec3(0.16, 0.30, 0.15), hill / 3.0) *
                (0.9 + 0.2 * noise(40 * u, 40 * v, 64, 64, seed));
    }
    return pixel(color * canvas);
  }
  if (number % 3 == 1) {
    glm::dvec3 color(0.93, 0.90, 0.84);
    for (uint32_t i = 0; i < 9; ++i) {
      const double radius = 0.06 + 0.2 * hashed(i, 7, seed);
      const double far = std::hypot((u - hashed(i, 5, seed)) * 1.33, v - hashed(i, 6, seed));
      if (far < radius) color = glm::mix(color, any_color(i), 0.75);
      if (std::abs(far - radius) < 0.006) color *= 0.35;
    }
    return pixel(color * canvas);
  }
  const glm::dvec3 fields[] = {{0.93, 0.92, 0.88}, {0.80, 0.14, 0.12}, {0.93, 0.92, 0.88},
                               {0.95, 0.78, 0.16}, {0.93, 0.92, 0.88}, {0.13, 0.22, 0.55}};
  uint32_t column = 0, row = 0;
  bool line = false;
  for (uint32_t i = 0; i < 4; ++i) {
    const double at_u = (i + 0.3 + 0.6 * hashed(i, 8, seed)) / 4,
                 at_v = (i + 0.3 + 0.6 * hashed(i, 9, seed)) / 4;
    column += u > at_u;
    row += v > at_v;
    line = line || std::abs(u - at_u) < 0.008 || std::abs(v - at_v) < 0.011;
  }
  if (line) return pixel(glm::dvec3(0.08));
  return pixel(fields[static_cast<size_t>(hashed(column, row, seed) * 6)] * canvas);
}

}  // namespace

std::string picture_image(int number) { return fmt::format("picture{}.png", number); }

void write_dressing_images(const std::filesystem::path& scene_folder, const Random& random) {
  const std::filesystem::path folder = scene_folder / images_folder;
  make_folder(folder);
  constexpr uint32_t side = 512;
  std::vector<std::function<void()>> images;
  const auto write = [&](const std::string& name, uint32_t width, uint32_t height, const auto& of) {
    images.emplace_back([=] { write_image_file(folder / name, width, height, of); });
  };
  using namespace surface_images;
  write(planks.name, side, side, [=](uint32_t x, uint32_t y) { return plank(x, y, side); });
  write(carpet.name, side, side, [=](uint32_t x, uint32_t y) { return carpet_pixel(x, y); });
  write(tiles.name, side / 2, side / 2, [=](uint32_t x, uint32_t y) { return tile_pixel(x, y, side / 2); });
  write(terrazzo.name, side, side, [=](uint32_t x, uint32_t y) { return terrazzo_pixel(x, y, side); });
  write(panels.name, side / 2, side / 2, [=](uint32_t x, uint32_t y) { return panel_pixel(x, y, side / 2); });
  write(bricks.name, side, side / 2,
        [=](uint32_t x, uint32_t y) { return brick_pixel(x, y, side, side / 2); });
  write(door.name, side / 2, side, [=](uint32_t x, uint32_t y) { return door_pixel(x, y, side / 2, side); });
  write(grass.name, side, side, [=](uint32_t x, uint32_t y) { return grass_pixel(x, y); });
  write(curtain_image, side / 4, side, [=](uint32_t x, uint32_t y) { return curtain_pixel(x, y, side); });
  write(blind_image, side / 2, side / 2, [=](uint32_t x, uint32_t y) { return blind_pixel(x, y, side / 2); });
  Random choice = random;
  const int first = static_cast<int>(choice.below(1000)) * 3;
  for (int i = 0; i < picture_images; ++i) {
    write(picture_image(i), side / 2, side * 3 / 8,
          [=](uint32_t x, uint32_t y) { return picture_pixel(first + i, x, y, side / 2, side * 3 / 8); });
  }
  parallel_for(images.size(), [&](size_t i) { images[i](); });
}

}  // namespace triptych
