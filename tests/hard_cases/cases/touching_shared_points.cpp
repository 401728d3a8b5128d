#include "tests/hard_cases/maker.hpp"

#include <map>

namespace triptych::hard_cases {
namespace {

const InGallery touching_shared_points(
    {.name = "touching_shared_points",
     .group = "touching",
     .breaks =
         "A closed surface whose pieces are objects of their own: each may move by its own bound, and gaps "
         "open between them.",
     .faults = {"loose-contacts"},
     .make = [] {
       Trial trial;
       const Mesh whole = awkward::wavy_sphere(40);
       std::map<int, Mesh> objects;
       for (const Triangle& triangle : whole.triangles) {
         const glm::dvec3& at = whole.positions[triangle.vertices[0]];
         Mesh& object = objects[(at.x > 0) + 2 * (at.y > 0) + 4 * (at.z > 0) +
                                8 * static_cast<int>(std::floor(std::abs(at.y) / 4))];
         Triangle own = triangle;
         for (uint32_t& corner : own.vertices) {
           object.positions.push_back(whole.positions[corner]);
           corner = static_cast<uint32_t>(object.positions.size() - 1);
         }
         object.triangles.push_back(own);
       }
       Maker maker;
       for (auto& [key, object] : objects) maker.mesh(std::move(object));
       trial.model = maker.model();
       trial.build = {.part_triangles = 200, .leaf_triangles = 200, .hlod_triangles = 48};
       trial.closed = true;
       for (int i = 0; i < 6; ++i) {
         const glm::dvec3 eye = 3.0 * glm::dvec3(std::cos(i), std::sin(i), 0.4 * std::sin(2.3 * i));
         trial.views.push_back(
             look(eye, eye + glm::dvec3(std::sin(2.1 * i), std::cos(3.0 * i), 0.3), 100, {160, 120}));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
