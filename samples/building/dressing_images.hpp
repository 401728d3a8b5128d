// The images that the dressed building shows: floors, ceilings, bricks, curtains, pictures.
#pragma once

#include "samples/random.hpp"

#include <filesystem>
#include <string>

namespace triptych {

/// An image that repeats, and how large one of it is; metres.
struct SurfaceImage {
  const char* name;
  double width, height;
};

namespace surface_images {
inline constexpr SurfaceImage planks{"oak.png", 2.0, 2.0}, carpet{"carpet.png", 1.5, 1.5},
    tiles{"tiles.png", 0.6, 0.6}, terrazzo{"terrazzo.png", 0.9, 0.9}, panels{"panels.png", 1.2, 1.2},
    bricks{"bricks.png", 1.0, 0.6}, door{"door.png", 1.0, 2.2}, grass{"grass.png", 6.0, 6.0};
}  // namespace surface_images

/// They are cut out: what is between the threads, and between the slats.
inline constexpr const char *curtain_image = "curtain.png", *blind_image = "blind.png";

inline constexpr int picture_images = 9;
std::string picture_image(int number);

/// The folder in the scene's that holds them; names above are in it.
inline constexpr const char* images_folder = "textures";

/// Writes them all.
void write_dressing_images(const std::filesystem::path& scene_folder, const Random& random);

}  // namespace triptych
