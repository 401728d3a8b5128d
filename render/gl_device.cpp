#include "render/gl_device.hpp"

#include "render/context.hpp"
#include "render/gl/frame_target.hpp"

namespace triptych {

namespace {

class GlDevice final : public Device {
 public:
  GlDevice(const Skeleton& skeleton, Representation& representation, Residency& residency, TestKind test)
      : passes_{.renderer = {skeleton, representation, residency},
                .rectangles = RectangleTest(test),
                .lines = {},
                .resolve = {},
                .lists = FragmentLists(),
                .sky = {}},
        names_(current_opengl()) {}

  std::unique_ptr<FrameTarget> make_target(TargetKind kind, int width, int height) override {
    return std::make_unique<GlFrameTarget>(passes_, kind, width, height);
  }
  const DeviceNames& names() const override { return names_; }
  void set_geometry_cap(uint64_t bytes) override { passes_.renderer.set_geometry_cap(bytes); }
  void set_missing(const MissingChunks& missing) override { passes_.renderer.set_missing(missing); }
  GeometryUse geometry_use() const override { return passes_.renderer.geometry_use(); }
  bool has_chunk(uint32_t chunk) const override { return passes_.renderer.has_chunk(chunk); }
  bool is_damaged(uint32_t chunk) const override { return passes_.renderer.is_damaged(chunk); }

 private:
  GlPasses passes_;
  DeviceNames names_;
};

}  // namespace

std::unique_ptr<Device> make_gl_device(const Skeleton& skeleton, Representation& representation,
                                       Residency& residency, TestKind test) {
  return std::make_unique<GlDevice>(skeleton, representation, residency, test);
}

std::vector<uint8_t> read_window(int width, int height) {
  std::vector<uint8_t> colors(static_cast<size_t>(width) * static_cast<size_t>(height) * 4);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glReadBuffer(GL_BACK);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, colors.data());
  return colors;
}

}  // namespace triptych
