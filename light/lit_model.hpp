// A model while light is baked into it: every placement on its own, in model space, as one list of triangles.
#pragma once

#include "model/model.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace triptych {

struct LitCorner {
  uint32_t place = 0;  ///< index into LitModel::places
  uint32_t point = 0;  ///< index into LightPoints, once they are made
  VertexColor color = {};
  VertexNormal normal = {};  ///< model space
  TextureCoordinates coordinates = {};
};

struct LitTriangle {
  std::array<LitCorner, 3> corners;
  uint32_t material = 0;
  uint32_t instance = 0;  ///< index into Model::instances, which stay in their order
};

struct LitModel {
  std::vector<glm::dvec3> places;  ///< different ones; what meets there, of whichever object, shares it
  std::vector<LitTriangle> triangles;
  double diagonal = 0;  ///< of the box of them

  /// The corner's position.
  const glm::dvec3& at(const LitCorner& corner) const { return places[corner.place]; }
  /// Of no certain length, to the front; zero of a triangle without area.
  glm::dvec3 normal(const LitTriangle& triangle) const;
};

/// What a placed model takes, bytes, before it is refined.
uint64_t lit_model_bytes(const Model& model);

/// The placements of a model without groups. Error (the model) for one whose triangles do not fit into
/// `memory`, with what to do.
LitModel place_all(const Model& model, uint64_t memory);

/// The model with a mesh of its own for each instance, in model space, with the given light of each point
/// (VertexLight). Instances whose mesh has no triangles are left as they were.
Model with_light(Model model, const LitModel& lit, const std::vector<VertexLight>& light);

}  // namespace triptych
