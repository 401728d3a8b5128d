// What shaders of surfaces do for their shade: source texts that several of them share.
#pragma once

#include "render/gl/shaders.hpp"

#include <optional>
#include <string>

namespace triptych {

/// Of the base colour, between vertices.
std::string flatness(BaseColors colors);

/// The shaded colour of a fragment, the same source text for every pass that draws colours: shade_fragment().
/// It wants eye_position, cap_color() and what belongs to that, and material_shader_source().
/// Where the variant is smooth, vertices have shading normals (eye_normal_source()), where it is baked or
/// occluded, baked light (vertex_light_source()). normal_location: for edges, where the normal of the face
/// goes.
std::string shaded(const ShaderVariant& variant, std::optional<int> normal_location = std::nullopt);

/// The shading normal of a vertex (VertexNormal) in eye space, by the cofactors of its placement; 0 where it
/// has none: eye_normal(), for the output shading_normal.
std::string eye_normal_source();

/// The baked light of a vertex (VertexLight), irradiance and openness: light_of_vertex(), for the output
/// baked_light.
std::string vertex_light_source();

}  // namespace triptych
