#include "render/context_osmesa.hpp"

#include "base/error.hpp"
#include "render/shared_library.hpp"

#include <GL/osmesa.h>
#include <array>

namespace triptych {

namespace {

const std::string place = "OSMesa";

/// Loaded only when a context is made, not with the program: LLVM comes with it, 44 MiB in every process, and
/// most processes draw nothing or use EGL.
struct Library {
  decltype(&::OSMesaCreateContextAttribs) create_context;
  decltype(&::OSMesaMakeCurrent) make_current;
  decltype(&::OSMesaDestroyContext) destroy_context;
  decltype(&::OSMesaGetProcAddress) address_of;

  Library() {
    const SharedLibrary file(place, "libOSMesa.so.8");
    file.find("OSMesaCreateContextAttribs", create_context);
    file.find("OSMesaMakeCurrent", make_current);
    file.find("OSMesaDestroyContext", destroy_context);
    file.find("OSMesaGetProcAddress", address_of);
  }
};

const Library& library() {
  static const Library library;
  return library;
}

class OsmesaContext : public Context {
 public:
  OsmesaContext() {
    const int wishes[] = {OSMESA_FORMAT,
                          OSMESA_RGBA,
                          OSMESA_PROFILE,
                          OSMESA_CORE_PROFILE,
                          OSMESA_CONTEXT_MAJOR_VERSION,
                          4,
                          OSMESA_CONTEXT_MINOR_VERSION,
                          5,
                          0};
    context_ = library().create_context(wishes, nullptr);
    if (!context_) fail(place, "no OpenGL 4.5 core context");
    // Pictures are drawn into framebuffer objects; this buffer only makes the context current.
    if (!library().make_current(context_, buffer_.data(), GL_UNSIGNED_BYTE, side, side)) {
      library().destroy_context(context_);
      fail(place, "the context cannot be made current");
    }
    load(library().address_of, place);
  }

  ~OsmesaContext() override { library().destroy_context(context_); }

 private:
  static constexpr int side = 16;
  std::array<unsigned char, side * side * 4> buffer_{};
  OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context() { return std::make_unique<OsmesaContext>(); }

}  // namespace triptych
