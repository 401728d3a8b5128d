// Visible sets that change in every way there is: pictures stay the un-culled ones.
#include "tests/session/scene_files.hpp"

#include <glm/geometric.hpp>

namespace triptych::test {
namespace {

class SessionSets : public SceneFiles {
 protected:
  struct Eye {
    glm::dvec3 eye, target, up{0, 1, 0};
  };

  /// Measures a session over the scene's pack along these cameras; every frame must be the un-culled picture.
  nlohmann::json play(const std::string& scene, const std::vector<Eye>& eyes,
                      std::vector<std::string> more = {}) {
    scenes::write_pack(scene, pack);
    nlohmann::json frames = nlohmann::json::array();
    const auto list = [](const glm::dvec3& v) { return nlohmann::json{v.x, v.y, v.z}; };
    for (const Eye& eye : eyes) {
      frames.push_back({{"eye", list(eye.eye)}, {"target", list(eye.target)}, {"up", list(eye.up)}});
    }
    std::ofstream(path) << nlohmann::json{{"triptych_path", 1}, {"frames", frames}};
    run(measure(std::move(more)));
    const nlohmann::json report = json_of(json);
    EXPECT_EQ(report["identical_frames"], eyes.size());
    EXPECT_EQ(report["frames_compared"], eyes.size());
    EXPECT_EQ(report["missing_drawables"], 0);
    EXPECT_EQ(report["digest_mismatches"], 0);
    EXPECT_EQ(report["fallback_frames"], 0);
    return report;
  }

  static Box box_of(const std::string& scene) {
    const Skeleton& skeleton = scenes::pack(scene).skeleton();
    return skeleton.lattice().box(skeleton.scene_nodes.front().box);
  }
  static std::vector<size_t> series(const nlohmann::json& report, const char* name) {
    return report.at("series").at(name).get<std::vector<size_t>>();
  }
};

TEST_F(SessionSets, levels_that_change_as_the_eye_comes_nearer) {
  const Box box = box_of("room");
  const glm::dvec3 centre = (box.lo + box.hi) * 0.5, away = glm::dvec3(1, 0.7, 2) * (box.hi - box.lo);
  std::vector<Eye> eyes;
  for (int i = 0; i < 24; ++i) {
    const double far = std::abs(12 - i) / 12.0;  // in, and out again
    eyes.push_back({centre + away * (0.55 + 4 * far * far), centre});
  }
  const auto report = play("room", eyes, {"--pixel-error", "4"});
  EXPECT_GT(report["delta"]["level_changes_mean"].get<double>(), 0.25) << "the path changes no levels";
}

TEST_F(SessionSets, camera_cuts_on_every_frame) {
  const Box box = box_of("room");
  const glm::dvec3 centre = (box.lo + box.hi) * 0.5, size = box.hi - box.lo;
  std::vector<Eye> eyes;
  for (int i = 0; i < 20; ++i) {
    const double angle = 2.4 * i;  // the golden angle: no two alike
    eyes.push_back(
        {centre + glm::dvec3(std::cos(angle), 0.3, std::sin(angle)) * size * (0.4 + 0.1 * (i % 5)), centre});
  }
  const auto report = play("room", eyes);
  EXPECT_LT(report["delta"]["saved_percent"].get<double>(), 60) << "the cameras are too much alike";
}

TEST_F(SessionSets, a_delta_that_is_larger_than_the_set) {
  const Box box = box_of("room");
  const glm::dvec3 centre = (box.lo + box.hi) * 0.5;
  const double step = (box.hi.x - box.lo.x) / 100;
  std::vector<Eye> eyes;
  for (int i = 0; i < 12; ++i) {  // turns round on the spot
    eyes.push_back({centre, centre + glm::dvec3(i % 2 ? step : -step, 0, 0)});
  }
  const auto report = play("room", eyes);
  const auto changed = series(report, "changed"), visible = series(report, "visible");
  size_t larger = 0;
  for (size_t i = 1; i < changed.size(); ++i) larger += visible[i] > 0 && changed[i] > visible[i];
  EXPECT_GT(larger, 5u);
}

TEST_F(SessionSets, an_empty_set_between_full_ones) {
  const Box box = box_of("room");
  const glm::dvec3 centre = (box.lo + box.hi) * 0.5, outside = box.hi + (box.hi - box.lo);
  std::vector<Eye> eyes;
  for (int i = 0; i < 12; ++i) {
    const bool away = i % 4 == 0 || i % 4 == 1;  // two frames of nothing, two of something
    eyes.push_back({outside, away ? outside + (outside - centre) : centre});
  }
  const auto visible = series(play("room", eyes), "visible");
  for (size_t i = 0; i < visible.size(); ++i) {
    EXPECT_EQ(visible[i] == 0, i % 4 == 0 || i % 4 == 1) << "frame " << i;
  }
}

TEST_F(SessionSets, nothing_but_empty_sets) {
  const Box box = box_of("room");
  const glm::dvec3 outside = box.hi + (box.hi - box.lo);
  const auto report = play("room", std::vector<Eye>(6, {outside, outside + (box.hi - box.lo)}));
  EXPECT_EQ(report["visible"]["max"], 0);
}

TEST_F(SessionSets, a_set_of_everything) {
  const Box box = box_of("slivers");
  const glm::dvec3 centre = (box.lo + box.hi) * 0.5;
  const double reach = glm::length(box.hi - box.lo);
  std::vector<Eye> eyes;
  for (int i = 0; i < 8; ++i) {  // all of it, at full detail, and nothing but a corner of it
    const glm::dvec3 above = centre + glm::dvec3(0, reach, 0);
    eyes.push_back({above, i % 2 ? box.hi + glm::dvec3(0.1, 0, 0.1) * reach : centre, {0, 0, 1}});
  }
  const auto report = play("slivers", eyes, {"--pixel-error", "0.01"});
  const auto visible = series(report, "visible"), cut = series(report, "cut");
  size_t most = 0;
  for (size_t i = 0; i < visible.size(); ++i) {
    if (visible[i] == cut[i]) most = std::max(most, visible[i]);
  }
  EXPECT_GT(most, 10u) << "no frame shows everything";
}

}  // namespace
}  // namespace triptych::test
