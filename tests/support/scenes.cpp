#include "tests/support/scenes.hpp"

#include "preprocess/build.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/object_sets.hpp"
#include "tests/support/painted_meshes.hpp"
#include "tests/support/smoothed.hpp"
#include "tests/support/textured_scene.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>
#include <map>
#include <stdexcept>
#include <unistd.h>

namespace triptych::scenes {

namespace {

/// A model in the making.
class Scene {
 public:
  Scene() {
    for (int i = 0; i < colors; ++i) {
      model_.materials.push_back(
          {glm::vec4(0.1 + 0.12 * i, 0.9 - 0.13 * ((3 * i) % colors), 0.2 + 0.1 * ((5 * i) % colors), 1)});
    }
  }
  static constexpr int colors = 7;

  /// Places the mesh in the next colour.
  void add(Mesh mesh, const Affine& transform = Affine(1)) {
    const auto color = static_cast<uint32_t>(model_.meshes.size() % colors);
    for (Triangle& triangle : mesh.triangles) triangle.material = color;
    model_.meshes.push_back(std::move(mesh));
    place(transform);
  }
  /// Places the last mesh once more.
  void place(const Affine& transform) {
    model_.instances.push_back({static_cast<uint32_t>(model_.meshes.size() - 1), transform});
  }
  void box(const glm::dvec3& lo, const glm::dvec3& hi) { add(awkward::box(lo, hi)); }
  /// The same of glass: all of it, or the first triangles.
  void glass(Mesh mesh, double alpha, const Affine& transform = Affine(1), size_t triangles = SIZE_MAX) {
    add(std::move(mesh), transform);
    std::vector<Triangle>& own = model_.meshes.back().triangles;
    Material material = model_.materials[own.front().material];
    material.base_color.a = static_cast<float>(alpha);
    for (size_t i = 0; i < std::min(triangles, own.size()); ++i)
      own[i].material = static_cast<uint32_t>(model_.materials.size());
    model_.materials.push_back(material);
  }
  /// Makes a group of what was placed since the last one.
  uint32_t group() {
    model_.groups.push_back({std::move(model_.instances), std::move(model_.group_instances)});
    model_.instances.clear();
    model_.group_instances.clear();
    return static_cast<uint32_t>(model_.groups.size() - 1);
  }
  void place_group(uint32_t group, const Affine& transform) {
    model_.group_instances.push_back({group, transform});
  }
  Model take() { return std::move(model_); }

 private:
  Model model_;
};

Model room(const glm::dvec3& origin) {
  Scene scene;
  Random random(11);
  const auto box = [&](const glm::dvec3& lo, const glm::dvec3& hi) { scene.box(origin + lo, origin + hi); };
  box({0, 0, -0.25}, {24, 12, 0});  // floor
  box({0, 0, 3}, {24, 12, 3.25});   // ceiling
  box({0, 0, 0}, {0.25, 12, 3});    // outer walls
  box({23.75, 0, 0}, {24, 12, 3});
  box({0, 0, 0}, {24, 0.25, 3});
  box({0, 11.75, 0}, {24, 12, 3});
  box({8, 0, 0}, {8.25, 5, 3});  // a wall with a door
  box({8, 6, 0}, {8.25, 12, 3});
  box({8, 5, 2}, {8.25, 6, 3});
  box({16, 0, 0}, {16.25, 12, 3});  // a wall without one
  for (int i = 0; i < 260; ++i) {
    const glm::dvec3 lo = random.vector() * glm::dvec3(22, 10.5, 2) + glm::dvec3(0.5, 0.5, 0);
    box(lo, lo + random.vector(0.05, 0.6));
  }
  scene.add(awkward::sphere(24, 0.8, origin + glm::dvec3(4, 6, 1.2)));
  scene.add(awkward::sphere(24, 0.9, origin + glm::dvec3(19, 6, 1.4)));
  return scene.take();
}

Model flat() {
  Scene scene;
  Random random(12);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 lo = random.vector(-5, 5);
    glm::dvec3 size = random.vector(0.2, 2);
    size[i % 3] = 0;
    if (i % 10 == 0) size[(i + 1) % 3] = 1e-4;
    scene.box(lo, lo + size);
  }
  return scene.take();
}

Model coplanar() {
  Scene scene;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      for (int z = 0; z < 4; ++z) {
        if ((x + 2 * y + 3 * z) % 4 != 0) scene.box({x, y, z}, {x + 1, y + 1, z + 1});
      }
    }
  }
  // Slabs and sheets in the planes of those faces.
  for (int i = 0; i <= 6; i += 2) {
    scene.box({i, 0, 0}, {i, 6, 4});
    scene.box({0, i, 1}, {6, i, 3});
    scene.box({0, 0, i / 2}, {6, 6, i / 2 + 1});
  }
  return scene.take();
}

Model slivers() {
  Scene scene;
  Random random(13);
  for (int object = 0; object < 120; ++object) {
    const glm::dvec3 center = random.vector(-4, 4), along = random.vector(-1, 1);
    Mesh mesh{"slivers", {}, {}};
    for (uint32_t i = 0; i < 12; ++i) {
      const glm::dvec3 start = center + random.vector(-0.3, 0.3);
      mesh.positions.push_back(start);
      mesh.positions.push_back(start + along * random.number(0.3, 2.5));
      mesh.positions.push_back(start + along * random.number(0.3, 2.5) +
                               random.vector(-1, 1) * std::exp2(-random.number(4, 18)));
      mesh.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, 0});
    }
    scene.add(std::move(mesh));
  }
  return scene.take();
}

Model dust() {
  Scene scene;
  Random random(14);
  scene.box({-6, 0, -6}, {6, 0.5, 6});
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 lo = random.vector(-4, 4);
    scene.box(lo, lo + random.vector() * std::exp2(-random.number(3, 12)));
  }
  return scene.take();
}

Model world() {
  Scene scene;
  Random random(15);
  scene.add(awkward::sphere(20, 10));
  for (int i = 0; i < 150; ++i) {
    const glm::dvec3 lo = random.vector(-5, 5);
    scene.box(lo, lo + random.vector(0.1, 1.5));
  }
  return scene.take();
}

glm::dmat3 rotation(Random& random) {
  const glm::dvec3 axis = glm::normalize(random.vector(-1, 1) + glm::dvec3(0, 0, 1e-3));
  return glm::dmat3(glm::rotate(glm::dmat4(1), random.number(0, 6.28), axis));
}

Affine placed(const glm::dmat3& linear, const glm::dvec3& at) {
  return Affine(linear[0], linear[1], linear[2], at);
}

Model instances() {
  Scene scene;
  Random random(16);
  scene.add(awkward::sphere(16, 0.5), placed(rotation(random), random.vector(-5, 5)));
  for (int i = 0; i < 120; ++i) {
    glm::dmat3 linear = rotation(random);
    linear[0] *= (i % 2 == 0 ? -1 : 1) * random.number(0.3, 2);
    linear[1] *= random.number(0.1, 2);
    scene.place(placed(linear, random.vector(-5, 5)));
  }
  scene.add(awkward::box({-1, -1, 0}, {1, 1, 0}), placed(rotation(random), random.vector(-5, 5)));
  for (int i = 0; i < 60; ++i)
    scene.place(placed(rotation(random) * random.number(0.2, 2), random.vector(-5, 5)));
  return scene.take();
}

Model sheared() {
  Scene scene;
  Random random(17);
  scene.add(awkward::sphere(16, 1), awkward::translation({0, 0, 0}));
  for (int i = 0; i < 60; ++i) {
    glm::dmat3 linear = rotation(random);
    linear[1] = linear[0] + linear[1] * std::exp2(-random.number(0, 26));
    if (i % 3 == 0) linear[2] *= std::exp2(-random.number(0, 20));
    scene.place(placed(linear, random.vector(-5, 5)));
  }
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 lo = random.vector(-5, 5);
    scene.box(lo, lo + random.vector(0.1, 1.5));
  }
  return scene.take();
}

Model triangle() {
  Scene scene;
  scene.add({"triangle", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.25}}, {{{0, 1, 2}, 0}}});
  return scene.take();
}

Model storeys() {
  Scene scene;
  Random random(18);
  // A room with furniture, three to a storey, one of them mirrored.
  scene.box({0, 0, 0}, {0.2, 6, 3});
  scene.box({0, 0, 0}, {6, 0.2, 3});
  for (int i = 0; i < 24; ++i) {
    const glm::dvec3 lo = random.vector() * glm::dvec3(5, 5, 1.5) + glm::dvec3(0.3, 0.3, 0);
    scene.box(lo, lo + random.vector(0.1, 0.7));
  }
  scene.add(awkward::sphere(12, 0.4), awkward::translation({3, 3, 1}));
  for (int i = 0; i < 4; ++i)
    scene.place(placed(rotation(random) * random.number(0.5, 1.5), random.vector(1, 2.5)));
  const uint32_t room_group = scene.group();
  scene.box({0, 0, -0.25}, {18, 6, 0});
  scene.place_group(room_group, Affine(1));
  scene.place_group(room_group, awkward::translation({6, 0, 0}));
  scene.place_group(room_group, placed(glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1), {18, 0, 0}));
  const uint32_t storey = scene.group();
  scene.box({-4, -4, -0.5}, {22, 10, -0.25});
  for (int i = 0; i < 4; ++i) scene.place_group(storey, awkward::translation({0, 0, 3.25 * i}));
  scene.place_group(storey, placed(rotation(random) * 0.5, {26, 4, 6}));
  scene.place_group(storey, placed(glm::dmat3(0, 1.5, 0, 1, 0, 0, 0, 0, 0.75), {-8, -6, 0}));
  scene.place_group(room_group, placed(glm::dmat3(2, 0, 0, 0, -1, 0, 0, 0, 1), {4, 14, 0}));
  return scene.take();
}

Model painted() {
  Scene scene;
  Random random(21);
  scene.add(test::painted_hills());
  for (int i = 0; i < 12; ++i) {
    const glm::dvec3 at = random.vector(0, 20);
    scene.add(test::painted_box(at, at + random.vector(0.5, 3)));
    scene.box(at + 3.0, at + 3.0 + random.vector(0.5, 2));
  }
  scene.add(test::painted_hills(), awkward::translation({0, 0, 6}));
  scene.place(placed(rotation(random) * 0.5, {-8, 0, 0}));
  scene.place(placed(glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1), {-1, 0, 3}));
  return scene.take();
}

Model glass() {
  Scene scene;
  Random random(23);
  scene.box({-1, -1, -0.25}, {21, 13, 0});
  scene.box({20, -1, 0}, {20.25, 13, 4});
  scene.box({8, 0, 0}, {8.25, 7, 3});
  for (int i = 0; i < 8; ++i) {  // panes one behind the other, and the last flush with a wall
    const double x = i == 7 ? 20 : 2 * i + 1;
    scene.glass(awkward::box({x - 0.05, 0, 0}, {x, 12, 3}), 0.15 + 0.1 * i);
  }
  for (int i = 0; i < 120; ++i) {  // things, some of them in glass
    const glm::dvec3 lo = random.vector() * glm::dvec3(18, 11, 2), hi = lo + random.vector(0.1, 0.8);
    if (i % 2 == 0) scene.box(lo, hi);
    if (i % 3 == 0) scene.glass(awkward::box(lo - 0.1, hi + 0.1), 0.3);
    if (i % 5 == 0) scene.glass(awkward::box({lo.x, lo.y, hi.z}, {hi.x, hi.y, hi.z + 0.02}), 0.5);  // flush
  }
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 lo = random.vector(0, 3) + glm::dvec3(3, 4, 0.5);
    scene.glass(awkward::box(lo, lo + 0.15), 0.4);
  }
  scene.glass(awkward::sphere(20, 1.5, {12, 6, 1.5}), 0.35);
  scene.glass(awkward::sphere(16, 1, {15, 9, 1.2}), 0.6, Affine(1), 300);  // through it its inside shows
  scene.glass(awkward::grid(20, 6, 0.5), 0.45, awkward::translation({10, 1, 2}));
  scene.place(placed(glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1), {9, 3, 2.5}));
  scene.place(placed(rotation(random) * 0.5, {4, 8, 2}));
  return scene.take();
}

Model smooth() {
  Scene scene;
  Random random(29);
  scene.box({-1, -1, -0.25}, {21, 13, 0});
  for (int i = 0; i < 24; ++i) {
    const glm::dvec3 at = random.vector() * glm::dvec3(18, 11, 3);
    scene.add(test::smoothed(awkward::sphere(6 + 2 * random.index(8), random.number(0.3, 1.2), at)));
    scene.box(at + 1.0, at + 1.0 + random.vector(0.2, 1));
    if (i % 3 == 0) scene.add(test::smoothed(awkward::box(at - 1.0, at - 0.4)));  // like a cushion
    if (i % 4 == 0)
      scene.add(awkward::sphere(12, 0.6, at + glm::dvec3(0, 0, 2)));  // faceted, coarse levels not
  }
  scene.add(test::smoothed(awkward::grid(24, 6, 0.8)), awkward::translation({8, 2, 1}));
  scene.add(test::smoothed(awkward::wavy_sphere(14)), placed(glm::dmat3(0.1), {4, 4, 5}));
  scene.place(placed(glm::dmat3(-0.1, 0, 0, 0, 0.2, 0, 0, 0, 0.1), {9, 4, 5}));  // mirrored and stretched
  scene.place(placed(rotation(random) * 0.15, {15, 8, 5}));
  scene.place(placed(rotation(random) * glm::dmat3(0.05, 0, 0, 0, 0.2, 0, 0, 0, 0.1), {2, 9, 5}));
  return scene.take();
}

struct Entry {
  std::string name;
  Model (*make)();
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {{"room",
                                          [] {
                                            return room({0, 0, 0});
                                          }},
                                         {"flat", flat},
                                         {"coplanar", coplanar},
                                         {"slivers", slivers},
                                         {"dust", dust},
                                         {"world", world},
                                         {"instances", instances},
                                         {"sheared", sheared},
                                         {"far",
                                          [] {
                                            return room({1e6, -1e6, 1e6});
                                          }},
                                         {"storeys", storeys},
                                         {"painted", painted},
                                         {"glass", glass},
                                         {"smooth", smooth},
                                         {"textured", textured},
                                         {"triangle", triangle}};
  return all;
}

}  // namespace

const std::vector<std::string>& names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> found;
    for (const Entry& entry : entries()) found.push_back(entry.name);
    return found;
  }();
  return all;
}

Model make(const std::string& name) {
  for (const Entry& entry : entries()) {
    if (entry.name == name) return entry.make();
  }
  throw std::invalid_argument("no scene is called " + name);
}

namespace {

void write(const std::string& name, const Model& model, const std::filesystem::path& file) {
  const uint32_t triangles = name == "dust" ? 12 : 128;
  build_pack(model, {.part_triangles = triangles, .leaf_triangles = triangles, .hlod_triangles = 96}, file);
}

using Packs = std::map<std::string, std::unique_ptr<Pack>>;

const Pack& known(Packs& packs, const std::string& name, const Model& model) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) /
                                     ("triptych_" + std::to_string(::getpid()) + "_" + name + ".tpk");
  write(name, model, file);
  const Pack& pack = *(packs[name] = std::make_unique<Pack>(file));
  std::filesystem::remove(file);  // the pack keeps it open
  return pack;
}

}  // namespace

void write_pack(const std::string& name, const std::filesystem::path& file) { write(name, make(name), file); }

void write_pack_with_objects(const std::string& name, const std::filesystem::path& file) {
  write(name, test::with_objects(make(name)), file);
}

const Pack& pack(const std::string& name) {
  static Packs packs;
  return packs[name] ? *packs[name] : known(packs, name, make(name));
}

const Pack& pack_with_objects(const std::string& name) {
  static Packs packs;
  return packs[name] ? *packs[name] : known(packs, name, test::with_objects(make(name)));
}

}  // namespace triptych::scenes
