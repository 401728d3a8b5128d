#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery geometry_awkward_meshes(
    {.name = "geometry_awkward_meshes",
     .group = "geometry",
     .breaks = "Soups, books of pages on one spine, pipes, doubled faces, tangles: nothing that a half-edge "
               "structure takes.",
     .faults = {"uncounted-lattice"},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.mesh(awkward::soup(60), linear({0.2, 0, 0}, {0, 0.2, 0}, {0, 0, 0.2}));
       maker.mesh(awkward::book(5, 6), awkward::translation({4, 0, 0}));
       maker.mesh(awkward::sphere(9), awkward::translation({0, 4, 0}));
       maker.mesh(awkward::grid(12, 3, 0.4), awkward::translation({4, 4, 0}));
       Mesh twice = awkward::grid(8, 2);
       awkward::append(twice, awkward::grid(8, 2));
       maker.mesh(twice, awkward::translation({8, 0, 0}));
       trial.model = maker.model();
       trial.views = around({4, 2, 0.5}, 8, 8);
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
