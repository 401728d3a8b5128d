#include "render/context.hpp"

#include "base/error.hpp"
#include "render/context_egl.hpp"
#include "render/context_osmesa.hpp"

#include <glad/gl.h>

namespace triptych {

namespace {
std::string text(GLenum name) {
  const GLubyte* characters = glGetString(name);
  return characters ? reinterpret_cast<const char*>(characters) : "";
}
}  // namespace

DeviceNames current_opengl() { return {text(GL_VENDOR), text(GL_RENDERER), text(GL_VERSION)}; }

void Context::load(Loader loader, const std::string& place) {
  const int version = gladLoadGL(loader);
  if (version < GLAD_MAKE_VERSION(4, 5)) {
    fail(place, "offers OpenGL {}.{}, 4.5 is needed", GLAD_VERSION_MAJOR(version),
         GLAD_VERSION_MINOR(version));
  }
  if (!GLAD_GL_ARB_shader_draw_parameters) fail(place, "lacks GL_ARB_shader_draw_parameters");
  names_ = current_opengl();
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glClearDepth(0);
  glDepthRange(0, 1);
  glDisable(GL_DITHER);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

std::unique_ptr<Context> make_context(ContextKind kind) {
  return kind == ContextKind::egl ? make_egl_context() : make_osmesa_context();
}

}  // namespace triptych
