// The shaders. One vertex stage serves every pass that draws geometry, so that all passes agree to the bit.
#pragma once

#include "scene/camera.hpp"

#include <glad/gl.h>
#include <string>

namespace triptych {

inline constexpr GLuint probe_binding = 0;    ///< storage: vertices of the rasteriser's probe
inline constexpr GLuint palette_binding = 1;  ///< storage: colours
/// What every shader begins with.
inline constexpr const char* shader_version = "#version 450\n";

inline constexpr GLuint rectangles_binding = 2;  ///< storage: rectangles under test
inline constexpr GLuint answers_binding = 3;     ///< storage: one word a rectangle
inline constexpr GLuint bounds_binding = 4;      ///< storage: one PixelDepthBound a piece
inline constexpr GLuint fragments_binding = 5;   ///< storage: fragments of what is transparent
inline constexpr GLuint materials_binding = 6;   ///< storage: one SurfaceMaterial a colour of the palette
inline constexpr GLuint textures_binding = 7;    ///< storage: where textures lie
inline constexpr GLuint texels_binding = 8;      ///< storage: texels
inline constexpr GLuint heads_image = 1;         ///< 32-bit integers, one a pixel: where its list begins
inline constexpr GLuint opaque_depths_unit = 3;  ///< textures: depth, of each plane a layer

/// Where base colours come from: the palette, the same for a whole triangle; or the vertices, interpolated.
enum class BaseColors { palette, vertices };

/// What a pass over geometry has besides depth and what it writes: each of it only where something calls for
/// it.
struct ShaderVariant {
  BaseColors colors = BaseColors::palette;
  bool smooth = false;    ///< vertices may have shading normals
  bool layers = false;    ///< some surface of the model lies on another one in its plane (scene/layers.hpp)
  bool sections = false;  ///< the view has a section
  bool caps = false;      ///< not surfaces, but the cut surfaces before their backs
  /// At the location after the others: half of the face's normal and a half; and of which side of the section
  /// it is the cut surface, in sixteenths, or 1.
  bool normals = false;
  bool transparent = false;  ///< not into a framebuffer, but into lists of fragments
  bool textured = false;     ///< vertices have places on textures, which may have holes
  bool emissive = false;     ///< surfaces have light of their own
  bool baked = false;        ///< in the light that vertices have, in place of the fixed one
  bool occluded = false;     ///< in the fixed one, as far as vertices are open to it
};

/// What surfaces have besides their colours: look_up(), to be called before any fragment is dropped; then
/// is_hole(), base_shown(base colour), covered(alpha) and with_glow(lit colour).
std::string material_shader_source(const ShaderVariant& variant);

/// For perspective views, or for orthographic ones, whose w is 1 and whose depth is linear.
std::string geometry_vertex_shader(Projection projection, const ShaderVariant& variant);
/// Only depth, flat-shaded base colours, and drawable ids; all move fragments nearer than their piece's
/// bound back to it, and drop those that a section does not keep.
std::string depth_fragment_shader(const ShaderVariant& variant);
std::string color_fragment_shader(const ShaderVariant& variant);
std::string item_fragment_shader(const ShaderVariant& variant);
inline constexpr GLuint nearest_backs_image = 0;  ///< 32-bit integers, one a pixel

/// Writes no output: drops what does not lie beyond where rays come into a section, and keeps the bits of the
/// nearest backs' depths in the image; with the uniform `forget` it writes 0 there.
std::string winding_fragment_shader();
/// Colours and ids in one pass, at locations 0 and 1.
std::string color_and_item_fragment_shader(const ShaderVariant& variant);

/// Appends to the lists of fragments what nothing opaque hides in the plane that the uniform `plane` names.
std::string transparent_fragment_shader(const ShaderVariant& variant);
/// The declarations of the lists.
std::string fragment_list_source();

/// Of a whole model in floats (FlatVertex), one transform for all of it; the same shading and no bounds.
std::string flat_model_vertex_shader(Projection projection);
/// sections: what ViewUniforms says of one is cut away.
std::string flat_model_fragment_shader(bool sections);

std::string rectangle_vertex_shader();
/// counting: of each rectangle how many pixels show, each once; otherwise whether any does.
std::string query_fragment_shader(bool counting);
std::string storage_fragment_shader(bool counting);

}  // namespace triptych
