// Culls a pack with a device of its own, as a program would that embeds triptych::visibility: one that never
// answers.
#include "lod/hierarchy.hpp"
#include "scene/pack.hpp"
#include "visibility/strategies.hpp"

#include <cstdio>
#include <exception>

namespace {

using namespace triptych;

/// Draws nothing, and leaves every answer as it found it: everything counts as visible.
class NoTarget final : public FrameTarget {
 public:
  int width() const override { return 64; }
  int height() const override { return 64; }
  TargetKind kind() const override { return TargetKind::depth_only; }
  void begin(const FrameView&) override {}
  void draw(std::span<const DrawableId>) override {}
  void test(std::span<const ScreenRectangle>, std::span<const uint32_t>, uint32_t,
            std::span<uint8_t>) override {}
  void finish() override {}
  uint64_t drawn_triangles() const override { return 0; }
  void draw_lines(std::span<const ScreenLine>) override {}
  std::vector<uint8_t> read_colors() const override { return {}; }
  std::vector<uint32_t> read_items(uint32_t) const override { return {}; }
  bool copy_to_window(int, int) const override { return false; }
};

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) return 2;
    const Pack pack(argv[1]);
    const Hierarchy hierarchy(pack.skeleton());
    const auto strategy = make_exact_strategy(StrategyKind::occlusion, hierarchy);
    FrameState state;
    state.view.width = state.view.height = 64;
    const FrameView view(pack.skeleton(), state);
    NoTarget target;
    NoSink nobody;
    strategy->representation()->begin(view, target);
    std::printf("%zu visible\n", strategy->run(view, {}, target, nobody).visible.size());
    return 0;
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
}
