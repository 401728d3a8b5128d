// The real program, as a user starts it: three processes, every picture compared with the un-culled one.
#include "base/file.hpp"
#include "tests/hard_cases/trials.hpp"
#include "tests/session/program.hpp"
#include "tests/support/path_text.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace triptych::hard_cases {

namespace {

using nlohmann::json;

void refuse(const std::string& pack, const std::string& path, const std::string& text, Problems& problems) {
  write_file(path, text);
  for (const std::string command : {"session", "render"}) {
    std::vector<std::string> arguments = {command, pack, "--path", path, "--size", "640x360"};
    if (command == "render") arguments.insert(arguments.end(), {"-o", path + ".pictures"});
    test::Program program(arguments);
    const int code = program.wait();
    const std::vector<std::string> lines = program.complaints();
    // JSON has no NaN: such a file is refused before its frames are read.
    const bool named = lines.size() == 1 && (lines[0].find("frame 0") != std::string::npos ||
                                             lines[0].find("is no JSON") != std::string::npos);
    if (code != 1 || !named || program.anybody_left())
      problems.push_back(fmt::format("{} takes {}: exit {}, {}", command, text, code, program.errors()));
  }
}

}  // namespace

Problems session_problems(const Trial& trial, const std::vector<std::string>& faults) {
  Problems problems;
  const BuiltTrial built(trial);
  const std::string pack = built.file().string(), path = pack + ".json", result = pack + ".result.json";
  for (const std::string& text : trial.refused_paths) refuse(pack, path, text, problems);
  if (!trial.views.empty()) {
    json frames = json::parse(test::path_text(trial.views));
    for (size_t i = 0; i < trial.times.size(); ++i) frames["frames"][i]["time_seconds"] = trial.times[i];
    write_file(path, frames.dump());
    std::vector<std::string> arguments = {"measure",
                                          "session",
                                          pack,
                                          "--path",
                                          path,
                                          "--json",
                                          result,
                                          "--size",
                                          fmt::format("{}x{}", trial.views[0].width, trial.views[0].height),
                                          "--pixel-error",
                                          fmt::format("{}", trial.pixel_error)};
    for (const std::string& fault : faults) arguments.insert(arguments.end(), {"--inject", fault});
    test::Program program(arguments);
    if (const int code = program.wait(); code != 0) {
      problems.push_back(fmt::format("exit {}: {}", code, program.errors()));
    } else {
      const json report = test::json_of(result);
      for (const char* key : {"frames", "frames_compared", "identical_frames"}) {
        if (report[key] != trial.views.size())
          problems.push_back(fmt::format("{} is {} of {}", key, report[key].dump(), trial.views.size()));
      }
      for (const char* key : {"digest_mismatches", "fallback_frames", "missing_drawables"}) {
        if (report[key] != 0) problems.push_back(fmt::format("{} is {}", key, report[key].dump()));
      }
    }
  }
  std::error_code ignored;
  for (const std::string& file : {path, result}) std::filesystem::remove(file, ignored);
  std::filesystem::remove_all(path + ".pictures", ignored);
  return problems;
}

}  // namespace triptych::hard_cases
