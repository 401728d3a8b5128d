// Lines in model space over a picture: boxes and frustums, for people.
#pragma once

#include "render/target.hpp"
#include "scene/box.hpp"
#include "scene/camera.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace triptych {

/// Gathers lines of any colours and draws them over whatever stands in a target, without a depth test: what
/// was culled lies behind something, and is what one wants to see.
class LinePass {
 public:
  LinePass();
  /// The view for the lines that follow, a perspective one; forgets those before. Ends are taken relative to
  /// the eye in doubles.
  void begin(const View& view);
  void add_line(const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color);
  /// The box's twelve edges.
  void add_box(const Box& box, const glm::vec4& color);
  /// The four edges of the view's frustum and its rectangle, `depth` model units from its eye.
  void add_frustum(const View& view, double depth, const glm::vec4& color);
  void draw(const Target& target);

 private:
  struct Vertex {
    glm::vec4 position, color;
  };
  GlProgram program_;
  GlVertexArray vertex_array_;
  StreamBuffer vertices_;
  View view_;
  glm::dmat3 rotation_{1};
  std::vector<Vertex> lines_;
};

}  // namespace triptych
