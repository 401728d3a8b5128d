// The gallery as a program: hard_cases list | run [CASE…] | mutants [FAULT…] | stress MINUTES SEED |
// states COUNT SEED | thumbnails FOLDER
#include "nodes/local_pipeline.hpp"
#include "render/png_file.hpp"
#include "tests/hard_cases/mutants.hpp"
#include "tests/hard_cases/states.hpp"
#include "tests/hard_cases/stress.hpp"
#include "tests/support/test_device.hpp"

#include <cstdlib>
#include <fmt/core.h>

namespace {

using namespace triptych;
using namespace triptych::hard_cases;

int list() {
  for (const HardCase& entry : gallery()) fmt::print("{}: {}\n", entry.name, entry.breaks);
  return 0;
}

int run(const std::vector<std::string>& names) {
  int failed = 0;
  for (const HardCase& entry : gallery()) {
    if (!names.empty() && std::find(names.begin(), names.end(), entry.name) == names.end()) continue;
    const Trial trial = entry.make();
    Problems problems = build_problems(trial);
    for (const Problems& more : {cut_problems(trial), picture_problems(trial, test::device())})
      problems.insert(problems.end(), more.begin(), more.end());
    for (const std::string& problem : problems) fmt::print("{}: {}\n", entry.name, problem);
    failed += !problems.empty();
  }
  return failed > 0 ? 1 : 0;
}

/// A small picture of the frame in the middle of each case's path, and of nothing else.
int thumbnails(const std::filesystem::path& folder) {
  constexpr int width = 128, height = 96;
  std::filesystem::create_directories(folder);
  for (const HardCase& entry : gallery()) {
    const Trial trial = entry.make();
    if (trial.views.empty()) continue;
    const BuiltTrial built(trial);
    FrameState state = trial.state_of(trial.views.size() / 2);
    state.view.width = width;
    state.view.height = height;
    LocalPipeline pipeline(built.pack(), {.width = width, .height = height, .device = test::device()});
    pipeline.draw({0, state});
    write_png(folder / (entry.name + ".png"), width, height, pipeline.target().read_colors());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const std::string command = words.empty() ? "" : words[0];
  const std::vector<std::string> rest(words.begin() + (words.empty() ? 0 : 1), words.end());
  try {
    if (command == "list") return list();
    if (command == "run") return run(rest);
    if (command == "stress" && rest.size() == 2) {
      const auto seed = static_cast<uint32_t>(std::stoul(rest[1]));
      return run_stress(std::stod(rest[0]), seed) > 0 ? 1 : 0;
    }
    if (command == "states" && rest.size() == 2) {
      const auto seed = static_cast<uint32_t>(std::stoul(rest[1]));
      return run_states(std::stoul(rest[0]), seed) > 0 ? 1 : 0;
    }
    if (command == "thumbnails" && rest.size() == 1) return thumbnails(rest[0]);
    if (command == "mutants") return run_mutants(rest) > 0 ? 1 : 0;
  } catch (const std::exception& error) {
    fmt::print("hard_cases: {}\n", error.what());  // standard error is full of progress
    return 1;
  }
  fmt::print(stderr,
             "hard_cases list | run [CASE…] | mutants [FAULT…] | stress MINUTES SEED | states COUNT SEED | "
             "thumbnails FOLDER\n");
  return 2;
}
