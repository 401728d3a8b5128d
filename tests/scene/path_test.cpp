#include "scene/path.hpp"

#include "base/error.hpp"
#include "base/file.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

Path load(const std::string& text) {
  const auto file = std::filesystem::path(testing::TempDir()) /
                    (std::string("triptych_path_") +
                     testing::UnitTest::GetInstance()->current_test_info()->name() + ".json");
  write_file(file, text);
  return load_path(file);
}

Path load_frames(const std::string& frames, const std::string& settings = R"("fov_y_degrees": 60)") {
  return load(R"({"triptych_path": 1, )" + settings + R"(, "frames": [)" + frames + "]}");
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const std::string good = R"({"eye": [1, 2, 3], "target": [1, 2, 2], "up": [0, 1, 0]})";

TEST(Path, frames_become_views_of_the_viewport) {
  const Path path = load_frames(good + "," + good);
  ASSERT_EQ(path.frames.size(), 2u);
  const View view = path.view(1, 400, 200, 0.125);
  EXPECT_EQ(view.camera.eye, glm::dvec3(1, 2, 3));
  EXPECT_NEAR(view.camera.top, std::tan(M_PI / 6), 1e-15);
  EXPECT_NEAR(view.camera.right, 2 * view.camera.top, 1e-15);
  EXPECT_EQ(view.camera.left, -view.camera.right);
  EXPECT_EQ(view.camera.near, 0.125);
  EXPECT_NEAR(view.focal_x(), view.focal_y(), 1e-9);
  EXPECT_NEAR(view.focal_y(), 100 / std::tan(M_PI / 6), 1e-9);
}

TEST(Path, settings_hold_for_every_frame_unless_a_frame_has_its_own) {
  const std::string own =
      R"({"eye": [0,0,0], "target": [1,0,0], "up": [0,0,1], "fov_y_degrees": 90, "near": 0.5})";
  const Path path = load_frames(good + "," + own, R"("fov_y_degrees": 30, "near": 0.25)");
  EXPECT_NEAR(path.view(0, 10, 10, 1).camera.top, std::tan(M_PI / 12), 1e-15);
  EXPECT_EQ(path.view(0, 10, 10, 1).camera.near, 0.25);
  EXPECT_NEAR(path.view(1, 10, 10, 1).camera.top, 1, 1e-12);
  EXPECT_EQ(path.view(1, 10, 10, 1).camera.near, 0.5);
}

TEST(Path, an_off_axis_frustum_is_taken_as_it_is) {
  const Path path = load_frames(good, R"("off_axis": [-0.1, 0.3, -0.2, 0.25])");
  const Camera camera = path.view(0, 640, 480, 1).camera;
  EXPECT_EQ(camera.left, -0.1);
  EXPECT_EQ(camera.right, 0.3);
  EXPECT_EQ(camera.bottom, -0.2);
  EXPECT_EQ(camera.top, 0.25);
  EXPECT_NE(error_of([] { load_frames(good, R"("off_axis": [0.3, -0.1, -0.2, 0.25])"); }).find("frustum"),
            std::string::npos);
}

TEST(Path, an_orthographic_height_spans_the_picture_in_model_units) {
  const std::string wide = R"({"eye": [0,0,0], "target": [1,0,0], "up": [0,0,1], "fov_y_degrees": 90})";
  const Path path = load_frames(good + "," + wide, R"("orthographic_height": 12)");
  const View view = path.view(0, 400, 200, 0.125);
  EXPECT_TRUE(view.camera.orthographic());
  EXPECT_EQ(view.camera.top, 6);
  EXPECT_EQ(view.camera.left, -12);
  EXPECT_EQ(view.focal_x(), 400.0 / 24);
  EXPECT_EQ(view.corner_stretch(), 1);
  EXPECT_FALSE(path.view(1, 400, 200, 0.125).camera.orthographic()) << "the frame's own projection";
}

TEST(Path, cameras_of_any_scale_have_a_direction) {
  for (const char* frame : {R"({"eye": [0,0,0], "target": [1e-200,0,0], "up": [0,0,1e-200]})",
                            R"({"eye": [0,0,0], "target": [1e200,0,0], "up": [0,0,1e200]})"}) {
    const glm::dmat3 rotation = load_frames(frame).view(0, 10, 10, 1).rotation();
    EXPECT_NEAR(rotation[0][2], -1, 1e-15) << frame;
    EXPECT_NEAR(rotation[2][1], 1, 1e-15) << frame;
  }
}

TEST(Path, a_camera_without_a_direction_or_an_up_vector_is_refused_with_its_frame) {
  const auto error = [](const std::string& frame) {
    return error_of([&] { load_frames(good + "," + frame); });
  };
  EXPECT_NE(error(R"({"eye": [0,0,0], "target": [0,0,0], "up": [0,1,0]})").find("frame 1"),
            std::string::npos);
  EXPECT_NE(error(R"({"eye": [0,0,0], "target": [0,0,1], "up": [0,0,0]})"), "");
  EXPECT_NE(error(R"({"eye": [0,0,0], "target": [0,0,1], "up": [0,0,-2]})"), "");
}

TEST(Path, numbers_that_are_not_finite_or_no_numbers_are_refused) {
  for (const char* bad : {"1e999", "-1e999", "NaN", "null", "\"1\"", "[1]"}) {
    const std::string frame =
        std::string(R"({"eye": [)") + bad + R"(,0,0], "target": [0,0,1], "up": [0,1,0]})";
    EXPECT_NE(error_of([&] { load_frames(frame); }), "") << bad;
  }
  EXPECT_NE(error_of([] { load_frames(R"({"eye": [1e308,0,0], "target": [-1e308,0,1], "up": [0,1,0]})"); }),
            "");
}

TEST(Path, a_path_without_frames_or_of_another_kind_is_refused) {
  EXPECT_NE(error_of([] { load_frames(""); }).find("no frames"), std::string::npos);
  for (const char* text :
       {"", "[]", "{}", "hello", R"({"triptych_path": 2, "frames": []})", R"({"triptych_path": 1})",
        R"({"triptych_path": 1, "frames": 5})", R"({"triptych_path": 1, "frames": [5]})",
        R"({"triptych_path": 1, "frames": [{}]})"}) {
    EXPECT_NE(error_of([&] { load(text); }), "") << text;
  }
  EXPECT_EQ(error_of([] { parse_path("{\"triptych_path\": 1,\n\"frames\": [}", "walk.json"); }),
            "walk.json: line 2, column 12: is no JSON: a value or ] is expected, not }");
  EXPECT_NE(error_of([] { load_path("/nonexistent/walk.json"); }).find("/nonexistent/walk.json"),
            std::string::npos);
}

TEST(Path, a_key_that_is_not_known_is_named_with_its_frame) {
  EXPECT_NE(error_of([] { load_frames(good, R"("lens": 60)"); }).find(".json: \"lens\" is not known"),
            std::string::npos);
  const std::string misspelt = R"({"eye": [0,0,0], "target": [0,0,1], "up": [0,1,0], "Near": 1})";
  EXPECT_NE(error_of([&] { load_frames(good + "," + misspelt); }).find("frame 1: \"Near\" is not known"),
            std::string::npos);
  EXPECT_NE(error_of([] { load_frames(good, R"("eye": [0,0,0])"); }).find("\"eye\" is not known"),
            std::string::npos);
  EXPECT_NE(error_of([] { load_frames(good, R"("time_seconds": "now")"); }), "");
}

TEST(Path, times_and_comments_change_no_view) {
  const std::string timed =
      R"({"eye": [1, 2, 3], "target": [1, 2, 2], "up": [0, 1, 0], "time_seconds": 0.5, "comment": "stairs"})";
  const Path path = load_frames(good + "," + timed, R"("time_seconds": 0, "comment": ["by", "hand"])");
  EXPECT_EQ(path.frames[0].time_seconds, 0.0);
  EXPECT_EQ(path.frames[1].time_seconds, 0.5);
  EXPECT_EQ(parse_path(path_text(path), "again").frames[1].time_seconds, 0.5);
  EXPECT_FALSE(load_frames(good).frames[0].time_seconds);
  EXPECT_EQ(path.view(1, 10, 10, 1).camera.top, path.view(0, 10, 10, 1).camera.top);
}

TEST(Path, impossible_settings_are_refused) {
  for (const char* settings :
       {R"("fov_y_degrees": 0)", R"("fov_y_degrees": 180)", R"("fov_y_degrees": "wide")", R"("near": 0)",
        R"("near": -1)", R"("off_axis": [1, 2])", R"("orthographic_height": 0)",
        R"("orthographic_height": -5)", R"("orthographic_height": 5, "fov_y_degrees": 60)",
        R"("orthographic_height": 5, "off_axis": [-1, 1, -1, 1])",
        R"("off_axis": [1, 1.0000000000001, -1, 1])"}) {
    EXPECT_NE(error_of([&] { load_frames(good, settings); }), "") << settings;
  }
}

TEST(Camera, its_rotation_turns_the_view_direction_to_minus_z_and_keeps_lengths) {
  View view{
      .camera = {.eye = {1, 2, 3}, .target = {4, -2, 8}, .up = {0.1, 0.9, 0.2}}, .width = 10, .height = 10};
  const glm::dmat3 rotation = view.rotation();
  const glm::dvec3 forward = rotation * (view.camera.target - view.camera.eye);
  EXPECT_NEAR(forward.x, 0, 1e-12);
  EXPECT_NEAR(forward.y, 0, 1e-12);
  EXPECT_NEAR(forward.z, -glm::length(view.camera.target - view.camera.eye), 1e-12);
  const glm::dvec3 up = rotation * view.camera.up;
  EXPECT_NEAR(up.x, 0, 1e-12);
  EXPECT_GT(up.y, 0);
  EXPECT_NEAR(glm::length(rotation * glm::dvec3(3, 4, 12)), 13, 1e-12);
}

TEST(Camera, the_corner_stretch_is_that_of_the_corner_furthest_from_the_axis) {
  View view;
  view.camera.left = -3;
  view.camera.right = 1;
  view.camera.bottom = -1;
  view.camera.top = 2;
  EXPECT_DOUBLE_EQ(view.corner_stretch(), std::sqrt(1 + 9 + 4));
}

}  // namespace
}  // namespace triptych
