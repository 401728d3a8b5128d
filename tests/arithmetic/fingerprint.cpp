// Cuts and bounds of many views, as one hash a scene: printed by this program as it was compiled, to be
// compared with what other compilers and options print. Coordinates are made of integers, so that they are
// the same everywhere.
#include "lod/cut.hpp"
#include "visibility/screen_bounds.hpp"

#include <cfenv>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

namespace triptych {
namespace {

/// FNV-1a.
class Hash {
 public:
  template <typename Value>
  void add(const Value& value) {
    unsigned char bytes[sizeof(Value)];
    std::memcpy(bytes, &value, sizeof(Value));
    for (const unsigned char byte : bytes) state_ = (state_ ^ byte) * 0x100000001b3ull;
  }
  unsigned long long value() const { return state_; }

 private:
  unsigned long long state_ = 0xcbf29ce484222325ull;
};

class Numbers {
 public:
  explicit Numbers(uint32_t seed) : generator_(seed) {}
  int integer(int lo, int hi) { return lo + static_cast<int>(generator_() % static_cast<uint32_t>(hi - lo)); }
  /// Between lo and hi, in thousandths of neither power of two.
  double number(int lo, int hi) { return integer(lo * 1000, hi * 1000) / 1000.0; }

 private:
  std::mt19937 generator_;
};

/// Four children an inner node, three levels of detail a leaf.
Skeleton make_skeleton(Numbers& numbers) {
  Skeleton skeleton;
  skeleton.lattices = {Lattice{{0, 0, 0}, 0x1p-12}};
  skeleton.scene_nodes.push_back({.box = {glm::ivec3(-1 << 18), glm::ivec3(1 << 18)}});
  for (uint32_t node = 0; node < 1365; ++node) {
    const bool inner = node < 341;
    if (inner) {
      const LatticeBox box = skeleton.scene_nodes[node].box;
      skeleton.scene_nodes[node].first_child = static_cast<uint32_t>(skeleton.scene_nodes.size());
      skeleton.scene_nodes[node].child_count = 4;
      for (int child = 0; child < 4; ++child) {
        LatticeBox part;
        for (int axis = 0; axis < 3; ++axis) {
          const int size = box.hi[axis] - box.lo[axis] + 2;
          part.lo[axis] = box.lo[axis] + numbers.integer(0, size / 2);
          part.hi[axis] = part.lo[axis] + numbers.integer(0, size / 2);
        }
        skeleton.scene_nodes.push_back({.box = part, .parent = node});
      }
    }
    SceneNode& scene_node = skeleton.scene_nodes[node];
    scene_node.first_drawable = static_cast<uint32_t>(skeleton.drawables.size());
    scene_node.drawable_count = inner ? 1 : 3;
    const double size = glm::length(glm::dvec3(scene_node.box.hi - scene_node.box.lo)) * 0x1p-12;
    for (uint32_t level = 0; level < scene_node.drawable_count; ++level)
      skeleton.drawables.push_back({.error = size * (inner ? 0.03 : 0.003 * level), .scene_node = node});
  }
  return skeleton;
}

View make_view(Numbers& numbers, int i) {
  View view{.camera = {}, .width = 300 + 7 * (i % 50), .height = 200 + 11 * (i % 40)};
  for (int axis = 0; axis < 3; ++axis) {
    view.camera.eye[axis] = numbers.number(-90, 90);
    view.camera.target[axis] = numbers.number(-60, 60);
    view.camera.up[axis] = numbers.number(-1, 1);
  }
  view.camera.left = numbers.number(-3, 0) - 0.001;
  view.camera.right = numbers.number(0, 3) + 0.001;
  view.camera.bottom = numbers.number(-3, 0) - 0.001;
  view.camera.top = numbers.number(0, 3) + 0.001;
  view.camera.near = numbers.number(0, 2) + 0.001;
  if (i % 4 == 3) view.camera.projection = Projection::orthographic;
  return view;
}

/// Under another rounding mode than ours, as a program around us may have set it.
unsigned long long fingerprint(uint32_t seed, int mode) {
  Numbers numbers(seed);
  const Skeleton skeleton = make_skeleton(numbers);
  Hash hash;
  for (int i = 0; i < 40; ++i) {
    const View view = make_view(numbers, i);
    std::fesetround(mode);
    const BoxProjector projector(FrameView(skeleton, {view}));
    for (const double pixel_error : {0.5, 1.0, 4.0}) {
      const FrameView frame_view(skeleton, {view, pixel_error});
      for (const DrawableId id : select_cut(frame_view).drawables) hash.add(id);
    }
    for (const SceneNode& node : skeleton.scene_nodes) {
      const ScreenBounds bounds = projector.bounds(node.box);
      hash.add(bounds.kind);
      hash.add(bounds.rectangle);
    }
    std::fesetround(FE_TONEAREST);
  }
  return hash.value();
}

}  // namespace
}  // namespace triptych

/// fingerprint [nearest|upward|downward|zero [LOCALE]]
int main(int argc, char** argv) {
  const char* word = argc > 1 ? argv[1] : "nearest";
  const int mode = word[0] == 'u'   ? FE_UPWARD
                   : word[0] == 'd' ? FE_DOWNWARD
                   : word[0] == 'z' ? FE_TOWARDZERO
                                    : FE_TONEAREST;
  if (argc > 2 && std::setlocale(LC_ALL, argv[2]) == nullptr) {
    std::fprintf(stderr, "fingerprint: there is no locale %s\n", argv[2]);
    return 1;
  }
  for (uint32_t seed = 1; seed <= 6; ++seed)
    std::printf("%u %016llx\n", seed, triptych::fingerprint(seed, mode));
  return 0;
}
