// Each fault that is put in on purpose shows in the comparison with the un-culled picture: the comparison can fail.
#include <gtest/gtest.h>

#include "base/inject.hpp"
#include "tests/render/rig.hpp"
#include "tests/support/scenes.hpp"

namespace triptych {
namespace {

/// Frames of the scene that differ from the un-culled picture.
size_t wrong_frames(const std::string& scene) {
  constexpr int width = 320, height = 240;
  const Pack& pack = scenes::pack(scene);
  Rig rig(pack, width, height);
  const std::vector<View> views = scenes::path(pack.skeleton(), width, height);
  size_t wrong = 0;
  for (size_t i = 0; i < views.size(); ++i) {
    const FrameRequest request{static_cast<uint32_t>(i), views[i], scenes::pixel_error(i)};
    wrong += rig.draw(request).differing_pixels > 0;
  }
  return wrong;
}

/// The same of many views through long lenses, at full detail: specks of a pixel or less.
size_t wrong_frames_of_specks() {
  constexpr int width = 320, height = 240;
  const Pack& pack = scenes::pack("dust");
  Rig rig(pack, width, height);
  size_t wrong = 0;
  for (const View& view : scenes::telescope_views(pack.skeleton(), width, height, 60, 7)) {
    wrong += rig.draw({0, view, 0}).differing_pixels > 0;
  }
  return wrong;
}

/// Faults that show together, and a scene that they show in.
struct Trial {
  std::vector<std::string> faults;
  std::string scene;
};

class Faults : public testing::TestWithParam<Trial> {
 protected:
  ~Faults() override { clear_injected(); }
};

TEST_P(Faults, change_pictures) {
  EXPECT_EQ(wrong_frames(GetParam().scene), 0u) << "without the fault";
  for (const std::string& fault : GetParam().faults) ASSERT_TRUE(inject(fault));
  const size_t wrong = wrong_frames(GetParam().scene);
  EXPECT_GT(wrong, 0u);
  RecordProperty("wrong_frames", std::to_string(wrong));
}

TEST(NoDilation, loses_specks_whose_box_covers_no_pixel) {
  EXPECT_EQ(wrong_frames_of_specks(), 0u) << "without the fault";
  ASSERT_TRUE(inject("no-dilation"));
  const size_t wrong = wrong_frames_of_specks();
  clear_injected();
  EXPECT_GT(wrong, 0u);
  RecordProperty("wrong_frames", std::to_string(wrong));
}

// A strict test alone changes nothing, because the margin of depth keeps a box before its own content; without that
// margin it does.
INSTANTIATE_TEST_SUITE_P(Injected, Faults,
                         testing::Values(Trial{{"withheld-id"}, "room"}, Trial{{"wrong-ancestor"}, "world"},
                                         Trial{{"strict-depth-test", "no-dilation"}, "coplanar"}),
                         [](const auto& parameter) {
                           std::string name;
                           for (const std::string& fault : parameter.param.faults) name += (name.empty() ? "" : "_and_") + fault;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace triptych
