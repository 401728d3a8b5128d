#include "render/context_egl.hpp"

#include "base/error.hpp"
#include "render/shared_library.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace triptych {

namespace {

const std::string place = "EGL";

/// Loaded when a context is made: the program also runs where there is none.
struct Library {
  decltype(&::eglGetProcAddress) address_of;
  decltype(&::eglGetError) error;
  decltype(&::eglInitialize) initialize;
  decltype(&::eglTerminate) terminate;
  decltype(&::eglBindAPI) bind_api;
  decltype(&::eglChooseConfig) choose_config;
  decltype(&::eglCreateContext) create_context;
  decltype(&::eglDestroyContext) destroy_context;
  decltype(&::eglMakeCurrent) make_current;

  Library() {
    const SharedLibrary file(place, "libEGL.so.1");
    file.find("eglGetProcAddress", address_of);
    file.find("eglGetError", error);
    file.find("eglInitialize", initialize);
    file.find("eglTerminate", terminate);
    file.find("eglBindAPI", bind_api);
    file.find("eglChooseConfig", choose_config);
    file.find("eglCreateContext", create_context);
    file.find("eglDestroyContext", destroy_context);
    file.find("eglMakeCurrent", make_current);
  }
};

const Library& egl() {
  static const Library library;
  return library;
}

class EglContext : public Context {
 public:
  EglContext() {
    const auto get_platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl().address_of("eglGetPlatformDisplayEXT"));
    if (!get_platform_display)
      fail(place, "is too old: it has no displays without a screen (EGL_EXT_platform_base)");
    display_ = get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || !egl().initialize(display_, nullptr, nullptr)) {
      fail(place, "has no driver that draws without a screen (EGL_MESA_platform_surfaceless): error {:#x}",
           egl().error());
    }
    egl().bind_api(EGL_OPENGL_API);
    const EGLint config_wishes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                    EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!egl().choose_config(display_, config_wishes, &config, 1, &count) || count == 0)
      fail(place, "has a driver without OpenGL");
    const EGLint context_wishes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     4,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     5,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
    context_ = egl().create_context(display_, config, EGL_NO_CONTEXT, context_wishes);
    if (context_ == EGL_NO_CONTEXT)
      fail(place, "has a driver without OpenGL 4.5 core, which is needed: error {:#x}", egl().error());
    if (!egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      fail(place, "the context cannot be made current: error {:#x}", egl().error());
    }
    load(egl().address_of, place);
  }

  ~EglContext() override {
    if (display_ == EGL_NO_DISPLAY) return;
    egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) egl().destroy_context(display_, context_);
    egl().terminate(display_);
  }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> make_egl_context() { return std::make_unique<EglContext>(); }

}  // namespace triptych
