#include "render/context_egl.hpp"

#include "base/error.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace triptych {

namespace {

const std::string place = "EGL";

class EglContext : public Context {
 public:
  EglContext() {
    const auto get_platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (!get_platform_display) fail(place, "has no platform displays (EGL_EXT_platform_base)");
    display_ = get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr)) {
      fail(place, "no surfaceless display: error {:#x}", eglGetError());
    }
    eglBindAPI(EGL_OPENGL_API);
    const EGLint config_wishes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                    EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display_, config_wishes, &config, 1, &count) || count == 0)
      fail(place, "no configuration for OpenGL");
    const EGLint context_wishes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     4,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     5,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, context_wishes);
    if (context_ == EGL_NO_CONTEXT) fail(place, "no OpenGL 4.5 core context: error {:#x}", eglGetError());
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      fail(place, "the context cannot be made current: error {:#x}", eglGetError());
    }
    load(eglGetProcAddress, place);
  }

  ~EglContext() override {
    if (display_ == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    eglTerminate(display_);
  }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> make_egl_context() { return std::make_unique<EglContext>(); }

}  // namespace triptych
