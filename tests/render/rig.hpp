// One scene drawn every way there is: culled by both kinds of test, un-culled, and as an item buffer.
#pragma once

#include "nodes/local_pipeline.hpp"
#include "render/context.hpp"
#include "tests/support/pictures.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace triptych {

using test::differing_pixels;

/// The process's context: the environment's TRIPTYCH_TEST_CONTEXT says which, "osmesa" or else EGL.
inline Context& test_context() {
  static const std::unique_ptr<Context> context = [] {
    const char* kind = std::getenv("TRIPTYCH_TEST_CONTEXT");
    return make_context(kind && std::string(kind) == "osmesa" ? ContextKind::osmesa : ContextKind::egl);
  }();
  return *context;
}

/// The fallback and, beside it, the un-culled picture of the same cut.
class Rig {
 public:
  Rig(const Pack& pack, int width, int height, TestKind test = TestKind::storage, CullOptions batches = {})
      : context_(test_context()),
        culled_(pack, {.width = width, .height = height, .batches = batches, .device = {test}}),
        whole_(pack, {.width = width, .height = height, .cull = StrategyKind::frustum}) {}

  struct Frame {
    FrameRecord record;
    size_t differing_pixels = 0;
  };
  Frame draw(const FrameRequest& request) {
    Frame frame{.record = culled_.draw(request)};
    whole_.draw(request);
    frame.differing_pixels = differing_pixels(culled_.target().read_colors(), whole_.target().read_colors());
    return frame;
  }

 private:
  Context& context_;
  LocalPipeline culled_, whole_;
};

}  // namespace triptych
