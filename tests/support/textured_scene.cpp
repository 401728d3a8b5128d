#include "tests/support/textured_scene.hpp"

#include "tests/support/awkward_meshes.hpp"
#include "tests/support/images.hpp"
#include "tests/support/scenes.hpp"

#include <cmath>

namespace triptych::scenes {

namespace {

uint8_t byte(double share) { return static_cast<uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0))); }

/// Smooth, of another size to each side, and of a size that no power of two is.
Texel cloth(uint32_t x, uint32_t y) {
  return {byte(0.5 + 0.4 * std::sin(x * 0.31)), byte(0.5 + 0.4 * std::cos(y * 0.23)),
          byte(0.4 + 0.3 * std::sin((x + y) * 0.17)), 255};
}
Texel wire(uint32_t x, uint32_t y) {
  const bool solid = x % 16 < 4 || y % 16 < 4;
  return {120, 130, 90, static_cast<uint8_t>(solid ? 255 : 0)};
}
/// Its alpha is smooth.
Texel leaf(uint32_t x, uint32_t y) {
  return {40, 140, 60, byte(0.9 - std::hypot(x / 37.0 - 0.5, y / 23.0 - 0.5))};
}

class TexturedScene {
 public:
  TexturedScene() {
    model_.images = {test::image_of("cloth", test::png_file(96, 40, cloth)),
                     test::image_of("wire", test::png_file(64, 64, wire)),
                     test::image_of("leaf", test::png_file(37, 23, leaf))};
    model_.materials.push_back({.base_color = {0.5f, 0.5f, 0.5f, 1}});
  }

  uint32_t material(const Material& material) {
    model_.materials.push_back(material);
    return static_cast<uint32_t>(model_.materials.size() - 1);
  }
  void add(Mesh mesh, uint32_t material, const Affine& transform = Affine(1), double repeats = 0.4) {
    for (Triangle& triangle : mesh.triangles) triangle.material = material;
    const Material& of = model_.materials[material];
    if (of.texture != no_id || of.emission_texture != no_id) add_coordinates(mesh, repeats);
    model_.meshes.push_back(std::move(mesh));
    place(transform);
  }
  void place(const Affine& transform) {
    model_.instances.push_back({static_cast<uint32_t>(model_.meshes.size() - 1), transform});
  }
  Model take() { return std::move(model_); }

  static constexpr uint32_t cloth_image = 0, wire_image = 1, leaf_image = 2;

 private:
  Model model_;
};

}  // namespace

void add_coordinates(Mesh& mesh, double repeats) {
  for (const glm::dvec3& p : mesh.positions)
    mesh.coordinates.push_back(texture_coordinates((p.x + 0.6 * p.z) * repeats, (p.y + 0.8 * p.z) * repeats));
}

Model textured() {
  TexturedScene scene;
  Random random(31);
  const uint32_t floor = scene.material({.base_color = {0.9f, 0.8f, 0.7f, 1}, .texture = 0});
  const uint32_t mirrored =
      scene.material({.base_color = {1, 1, 1, 1},
                      .texture = 0,
                      .sampler = {TextureWrap::mirrored_repeat, TextureWrap::clamp, false}});
  const uint32_t coarse = scene.material({.base_color = {1, 0.9f, 0.9f, 1},
                                          .texture = 0,
                                          .sampler = {TextureWrap::repeat, TextureWrap::repeat, true}});
  const uint32_t fence = scene.material({.base_color = {1, 1, 1, 1}, .texture = 1, .cutoff = 0.5f});
  const uint32_t foliage = scene.material({.base_color = {1, 1, 1, 1}, .texture = 2, .cutoff = 0.4f});
  const uint32_t glass = scene.material({.base_color = {1, 1, 1, 0.6f}, .texture = 2, .blends = true});
  const uint32_t lamp = scene.material({.base_color = {0.2f, 0.2f, 0.2f, 1}, .emission = {0.9f, 0.7f, 0.3f}});
  const uint32_t sign =
      scene.material({.base_color = {0.1f, 0.1f, 0.1f, 1}, .emission_texture = 0, .emission = {1, 1, 1}});
  const uint32_t plain = scene.material({.base_color = {0.3f, 0.5f, 0.7f, 1}});
  scene.add(awkward::box({-1, -1, -0.25}, {21, 13, 0}), floor);
  scene.add(awkward::box({20, -1, 0}, {20.25, 13, 4}), mirrored);
  scene.add(awkward::box({8, 0, 0}, {8.25, 7, 3}), coarse);
  for (int i = 0; i < 6; ++i) {  // fences one behind the other, and the last flush with a wall
    const double x = i == 5 ? 20 : 3 * i + 1;
    scene.add(awkward::box({x - 0.02, 0, 0}, {x, 12, 2.5}), i % 2 == 0 ? fence : foliage, Affine(1), 0.7);
  }
  for (int i = 0; i < 120; ++i) {
    const glm::dvec3 lo = random.vector() * glm::dvec3(18, 11, 2), hi = lo + random.vector(0.1, 0.8);
    const uint32_t all[] = {floor, plain, mirrored, lamp, coarse, fence, sign, glass};
    scene.add(awkward::box(lo, hi), all[i % 8], Affine(1), 1.5);
  }
  scene.add(awkward::sphere(20, 1.5, {12, 6, 1.5}), foliage);
  scene.add(awkward::sphere(16, 1, {15, 9, 1.2}), floor);
  Mesh hills = awkward::grid(20, 6, 0.5);
  for (const glm::dvec3& p : hills.positions)
    hills.colors.push_back({byte(p.x / 6), byte(p.y / 6), 200, 255});
  scene.add(std::move(hills), floor, awkward::translation({10, 1, 2}));
  scene.place(Affine(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(9, 3, 2.5)));
  return scene.take();
}

}  // namespace triptych::scenes
