#include "samples/effects/moving.hpp"

#include "samples/solids.hpp"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace triptych {

namespace {

/// Quaternions of turns about an axis.
std::vector<float> turns(const glm::dvec3& axis, const std::vector<double>& angles) {
  std::vector<float> values;
  for (const double angle : angles) {
    for (int i = 0; i < 3; ++i) values.push_back(static_cast<float>(axis[i] * std::sin(angle / 2)));
    values.push_back(static_cast<float>(std::cos(angle / 2)));
  }
  return values;
}

}  // namespace

MovingThings add_moving_things(GltfWriter& writer, bool moves) {
  MovingThings added;
  const auto mesh = [&](const char* name, const std::vector<MeshPart>& parts) {
    ++added.objects;
    for (const MeshPart& part : parts) added.triangles += part.indices.size() / 3;
    return writer.add_mesh(name, parts);
  };
  constexpr double pi = std::numbers::pi;
  const glm::dvec3 wood(0.45, 0.28, 0.15), brass(0.8, 0.65, 0.2), steel(0.7, 0.72, 0.75);
  constexpr double width = 0.9, top = 2.05, thick = 0.04, post = 0.08;
  const glm::dvec3 at(2.3, 0, 2.6);
  writer.add_node("door frame",
                  mesh("door frame", {box({-post, 0, -post}, {0, top + post, post}, wood),
                                      box({width, 0, -post}, {width + post, top + post, post}, wood),
                                      box({0, top, -post}, {width, top + post, post}, wood)}),
                  glm::translate(glm::dmat4(1), at));
  const size_t door = writer.add_moving_node(
      "door", mesh("door", {box({0.01, 0.01, -thick / 2}, {width - 0.01, top - 0.01, thick / 2}, wood)}), at);
  writer.add_node("knob", mesh("knob", {box({width - 0.15, 0.98, -0.1}, {width - 0.08, 1.05, 0.1}, brass)}),
                  glm::dmat4(1), door);
  std::vector<MeshPart> blades = {box({-0.06, -0.06, -0.05}, {0.06, 0.06, 0.05}, brass)};
  for (const double side : {-1.0, 1.0}) {
    const auto blade = [&](const glm::dvec3& a, const glm::dvec3& b) {
      blades.push_back(box(glm::min(a, b), glm::max(a, b), steel));
    };
    blade({side * 0.06, -0.05, -0.01}, {side * 0.55, 0.05, 0.01});
    blade({-0.05, side * 0.06, -0.01}, {0.05, side * 0.55, 0.01});
  }
  const size_t fan = writer.add_moving_node("fan", mesh("fan", blades), {3.9, 1.9, -3.2});
  if (!moves) return added;
  writer.animate(door, "rotation", {0, 2, 3, 5, 6}, turns({0, 1, 0}, {0, -pi / 2, -pi / 2, 0, 0}));
  writer.animate(
      fan, "rotation", {0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 5.5, 6},
      turns({0, 0, 1}, {0, pi / 2, pi, 3 * pi / 2, 0, pi / 2, pi, 3 * pi / 2, 0, pi / 2, pi, 3 * pi / 2, 0}));
  return added;
}

}  // namespace triptych
