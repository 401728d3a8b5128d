// Surfaces that touch, joined where an HLOD holds them all.
#pragma once

#include "preprocess/hlod.hpp"

namespace triptych {

/// Joins the surface to itself where held points (LeafSpan) touch, so that both sides of a contact move
/// together when it is simplified: points within `contact_steps` of each other become one, and edges between
/// held points are divided at held points that lie on them. Neither is done where a triangle would lose its
/// area or turn around. Returns how far a point of the surface moved at most, lattice steps.
double stitch(Baked& baked);

}  // namespace triptych
