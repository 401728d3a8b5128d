// The shaders. One vertex stage serves every pass that draws geometry, so that all passes agree to the bit.
#pragma once

#include "scene/camera.hpp"

#include <glad/gl.h>
#include <string>

namespace triptych {

inline constexpr GLuint probe_binding = 0;       ///< storage: vertices of the rasteriser's probe
inline constexpr GLuint palette_binding = 1;     ///< storage: colours
inline constexpr GLuint rectangles_binding = 2;  ///< storage: rectangles under test
inline constexpr GLuint answers_binding = 3;     ///< storage: one word a rectangle
inline constexpr GLuint bounds_binding = 4;      ///< storage: one PixelDepthBound a piece

/// Where base colours come from: the palette, the same for a whole triangle; or the vertices, interpolated.
enum class BaseColors { palette, vertices };

/// Whether any surface of the model lies on another one in its plane (scene/layers.hpp).
enum class Layers { none, some };

/// For perspective views, or for orthographic ones, whose w is 1 and whose depth is linear.
std::string geometry_vertex_shader(Projection projection, BaseColors colors = BaseColors::palette,
                                   Layers layers = Layers::none);
/// Only depth, flat-shaded base colours, and drawable ids; all drop fragments nearer than their piece's
/// bound.
std::string depth_fragment_shader(Layers layers = Layers::none);
/// normals: at the location after the others, half of the face's and a half.
std::string color_fragment_shader(BaseColors colors = BaseColors::palette, Layers layers = Layers::none,
                                  bool normals = false);
std::string item_fragment_shader(Layers layers = Layers::none);
/// Colours and ids in one pass, at locations 0 and 1.
std::string color_and_item_fragment_shader(BaseColors colors = BaseColors::palette,
                                           Layers layers = Layers::none, bool normals = false);

/// Of a whole model in floats (FlatVertex), one transform for all of it; the same shading and no bounds.
std::string flat_model_vertex_shader(Projection projection);
std::string flat_model_fragment_shader();

std::string rectangle_vertex_shader();
/// counting: of each rectangle how many pixels show, each once; otherwise whether any does.
std::string query_fragment_shader(bool counting);
std::string storage_fragment_shader(bool counting);

}  // namespace triptych
