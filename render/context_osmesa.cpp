#include "render/context_osmesa.hpp"

#include "base/error.hpp"

#include <GL/osmesa.h>
#include <array>

namespace triptych {

namespace {

const std::string place = "OSMesa";

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
    context_ = OSMesaCreateContextAttribs(wishes, nullptr);
    if (!context_) fail(place, "no OpenGL 4.5 core context");
    // Pictures are drawn into framebuffer objects; this buffer only makes the context current.
    if (!OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, side, side)) {
      OSMesaDestroyContext(context_);
      fail(place, "the context cannot be made current");
    }
    load(OSMesaGetProcAddress, place);
  }

  ~OsmesaContext() override { OSMesaDestroyContext(context_); }

 private:
  static constexpr int side = 16;
  std::array<unsigned char, side * side * 4> buffer_{};
  OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context() { return std::make_unique<OsmesaContext>(); }

}  // namespace triptych
