// What a session says of itself: when stages ran, where a camera's time went, what was sent.
#include "tests/session/scene_files.hpp"

#include <map>

namespace triptych::test {
namespace {

class SessionFigures : public SceneFiles {
 protected:
  const std::string timeline = folder.file("timeline.json");
};

TEST_F(SessionFigures, the_timeline_has_the_stages_of_every_frame_of_every_process_on_one_clock) {
  run(session({"--timeline", timeline}));
  const nlohmann::json trace = json_of(timeline);
  std::map<int, std::string> processes;
  std::map<std::string, std::map<int, std::pair<double, double>>>
      spans;  // process and stage, frame: begin, end
  for (const auto& event : trace.at("traceEvents")) {
    const int pid = event.at("pid");
    if (event.at("ph") == "M") {
      if (event.at("name") == "process_name") processes[pid] = event.at("args").at("name");
      continue;
    }
    const double begin = event.at("ts");
    EXPECT_GE(begin, 0);
    spans[processes[pid] + ": " + event.at("name").get<std::string>()][event.at("args").at("frame")] = {
        begin, begin + event.at("dur").get<double>()};
  }
  ASSERT_EQ(processes.size(), 3u);
  double uncertainty_us = 0;
  for (const auto& clock : trace.at("otherData").at("clocks")) {
    uncertainty_us = std::max(uncertainty_us, 1000 * clock.at("uncertainty_ms").get<double>());
    EXPECT_EQ(clock.at("spans_lost"), 0);
  }
  EXPECT_GT(uncertainty_us, 0) << "nobody compared clocks";
  for (int frame = 0; frame < static_cast<int>(frame_count); ++frame) {
    const std::string culling = frame % 2 == 0 ? "switch node 0" : "switch node 1";
    ASSERT_TRUE(spans[culling + ": hardware cull"].count(frame)) << frame;
    ASSERT_TRUE(spans["render node: finish picture"].count(frame)) << frame;
    // No picture stands before its culling has begun.
    EXPECT_LT(spans[culling + ": hardware cull"][frame].first,
              spans["render node: finish picture"][frame].second + 2 * uncertainty_us)
        << frame;
    if (frame == 0) continue;
    // R(i) stands before it is culled against.
    ASSERT_TRUE(spans[culling + ": finish occlusion representation"].count(frame)) << frame;
    EXPECT_LE(spans[culling + ": finish occlusion representation"][frame].second,
              spans[culling + ": hardware cull"][frame].first)
        << frame;
  }
}

TEST_F(SessionFigures, a_camera_s_way_to_its_picture_adds_up) {
  run(measure());
  const nlohmann::json latency = json_of(json).at("latency_ms");
  EXPECT_EQ(latency.at("frames"), frame_count - 1);
  const auto mean = [&](const char* part) { return latency.at(part).at("mean").get<double>(); };
  double sum = mean("remainder");
  for (const char* part : {"waiting", "occlusion_representation", "hardware_cull", "network", "render"}) {
    EXPECT_GE(mean(part), 0) << part;
    sum += mean(part);
  }
  EXPECT_NEAR(sum, mean("whole"), 1e-6);
  EXPECT_LT(std::abs(mean("remainder")), 0.1 * mean("whole")) << "parts are missing";
}

TEST_F(SessionFigures, traffic_is_what_sockets_and_the_kernel_counted) {
  run(measure());
  const nlohmann::json report = json_of(json), traffic = report.at("traffic");
  double by_socket = 0, by_receiver = 0;
  for (const auto& socket : traffic.at("sockets")) {
    by_socket += socket.at("bytes_per_frame").get<double>();
    // The kernel counts what was sent again as well, and the handshake of a message that we count too.
    EXPECT_GE(socket.at("kernel_bytes_per_frame").get<double>(),
              socket.at("bytes_per_frame").get<double>() - 1e-9)
        << socket.at("socket");
    EXPECT_GT(socket.at("least_round_trip_ms").get<double>(), 0) << socket.at("socket");
  }
  for (const auto& receiver : traffic.at("receivers")) {
    by_receiver += receiver.at("bytes_per_frame").get<double>();
  }
  const double whole = traffic.at("bytes_per_frame");
  EXPECT_EQ(traffic.at("sockets").size(), 12u);
  EXPECT_NEAR(by_socket, whole, 1e-6);
  EXPECT_NEAR(by_receiver, whole, 1e-6);
  EXPECT_NEAR(traffic.at("formula_bytes_per_frame").get<double>(),
              366 + 8.5 * (report.at("delta").at("added_mean").get<double>() +
                           report.at("delta").at("removed_mean").get<double>()),
              1e-6);
}

TEST_F(SessionFigures, one_process_has_a_timeline_too) {
  run({"render", pack, "--path", path, "--size", "160x120", "--frames", "3", "-o", folder.file("pictures"),
       "--timeline", timeline});
  size_t culled = 0;
  const nlohmann::json trace = json_of(timeline);
  for (const auto& event : trace.at("traceEvents")) culled += event.at("name") == "hardware cull";
  EXPECT_EQ(culled, 3u);
}

}  // namespace
}  // namespace triptych::test
