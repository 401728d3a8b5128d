// Small models whose light is known.
#pragma once

#include "light/bake.hpp"

#include <glm/geometric.hpp>

namespace triptych::test {

/// A rectangle of two triangles for each of columns × rows, from a corner along two edges; seen from where
/// they go round counter-clockwise.
inline void add_rectangle(Mesh& mesh, const glm::dvec3& corner, const glm::dvec3& along, const glm::dvec3& up,
                          uint32_t columns, uint32_t rows, uint32_t material) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (uint32_t row = 0; row <= rows; ++row)
    for (uint32_t column = 0; column <= columns; ++column)
      mesh.positions.push_back(corner + along * (double(column) / columns) + up * (double(row) / rows));
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t column = 0; column < columns; ++column) {
      const uint32_t a = first + row * (columns + 1) + column, b = a + 1, c = a + columns + 1, d = c + 1;
      mesh.triangles.push_back({{a, b, d}, material});
      mesh.triangles.push_back({{a, d, c}, material});
    }
  }
}

inline Material grey(float reflectance, float emission = 0) {
  Material material;
  material.base_color = {reflectance, reflectance, reflectance, 1};
  material.emission = glm::vec3(emission);
  return material;
}

/// One mesh, placed once.
inline Model model_of(Mesh mesh, std::vector<Material> materials) {
  Model model;
  model.files = {"room"};
  model.meshes.push_back(std::move(mesh));
  model.materials = std::move(materials);
  model.instances.push_back({0, Affine(1)});
  return model;
}

/// A floor of side 4 around the origin, y up, in so many squares a side.
inline Model floor_model(uint32_t squares, float reflectance = 0.5f) {
  Mesh mesh;
  add_rectangle(mesh, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, squares, squares, 0);
  return model_of(std::move(mesh), {grey(reflectance)});
}

/// The inside of a closed box of side 2, faces looking inwards.
inline Model inside_of_box(uint32_t squares, Material material) {
  Mesh mesh;
  const auto add = [&](const glm::dvec3& corner, const glm::dvec3& along, const glm::dvec3& up) {
    add_rectangle(mesh, corner, along, up, squares, squares, 0);
  };
  add({-1, -1, 1}, {2, 0, 0}, {0, 0, -2});  // floor
  add({-1, 1, -1}, {2, 0, 0}, {0, 0, 2});   // ceiling
  add({-1, -1, -1}, {2, 0, 0}, {0, 2, 0});  // back
  add({1, -1, 1}, {-2, 0, 0}, {0, 2, 0});   // front
  add({-1, -1, 1}, {0, 0, -2}, {0, 2, 0});  // left
  add({1, -1, -1}, {0, 0, 2}, {0, 2, 0});   // right
  return model_of(std::move(mesh), {material});
}

inline ModelLight point_light(const glm::dvec3& position, double candela) {
  ModelLight light;
  light.position = position;
  light.intensity = glm::dvec3(candela);
  return light;
}

/// Without any refinement.
inline LightOptions as_it_is() {
  LightOptions options;
  options.bake = true;
  options.shortest_edge = options.longest_edge = 10;
  return options;
}

}  // namespace triptych::test
