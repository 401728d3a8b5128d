#include "tests/hard_cases/mutants.hpp"

#include "base/inject.hpp"
#include "tests/support/test_device.hpp"

#include <fmt/core.h>
#include <map>
#include <sstream>

namespace triptych::hard_cases {

namespace {

struct Finding {
  std::string stage, problem;  ///< empty: nothing was noticed
};

std::vector<std::string> parts_of(const std::string& faults) {
  std::vector<std::string> parts;
  std::istringstream in(faults);
  for (std::string part; std::getline(in, part, '+');) parts.push_back(part);
  return parts;
}

std::string first_line(const std::string& text) {
  return text.substr(0, std::min(text.find('\n'), size_t{100}));
}

/// The first stage that notices something, cheap ones first. Messages exist in sessions alone.
Finding examine(const Trial& trial, const std::vector<std::string>& faults) {
  const auto finding = [](const char* stage, const Problems& problems) {
    return problems.empty() ? Finding() : Finding{stage, problems.front()};
  };
  try {
    if (Finding found = finding("build", build_problems(trial)); !found.stage.empty()) return found;
    if (Finding found = finding("cut", cut_problems(trial)); !found.stage.empty()) return found;
    if (Finding found = finding("pictures", picture_problems(trial, test::device())); !found.stage.empty())
      return found;
  } catch (const std::exception& error) {
    return {"error", error.what()};
  }
  const std::vector<std::string> active = injected_names();
  clear_injected();  // of this process; the program gets them by name
  const bool of_messages = faults.empty() || faults[0] == "wrong-delta" || faults[0] == "flipped-byte";
  if (of_messages && !faults.empty()) return finding("session", session_problems(trial, active));
  return {};
}

}  // namespace

int run_mutants(const std::vector<std::string>& only) {
  std::map<std::string, std::vector<const HardCase*>> named;
  for (const HardCase& entry : gallery()) {
    for (const std::string& fault : entry.faults) named[fault].push_back(&entry);
  }
  std::map<std::string, Finding> without;
  int wrong = 0;
  fmt::print("{:<34} {:<38} {:<9} {}\n", "fault", "case", "stage", "what it noticed");
  for (const auto& [fault, cases] : named) {
    if (!only.empty() && std::find(only.begin(), only.end(), fault) == only.end()) continue;
    if (fault == "no-fragment-bound" && !test::on_gl()) {
      fmt::print("{:<34} the depths of cpu keep their bounds without it: see docs/algorithms.md\n", fault);
      continue;
    }
    for (const HardCase* entry : cases) {
      const Trial trial = entry->make();
      clear_injected();
      if (!without.count(entry->name)) without[entry->name] = examine(trial, {});
      const Finding& before = without[entry->name];
      const std::vector<std::string> faults = parts_of(fault);
      for (const std::string& part : faults) {
        if (!inject(part)) {
          fmt::print("{} names {}, which is no fault\n", entry->name, part);
          ++wrong;
        }
      }
      const Finding after = examine(trial, faults);
      clear_injected();
      const bool survived = after.stage.empty(), failed_before = !before.stage.empty();
      fmt::print("{:<34} {:<38} {:<9} {}\n", fault, entry->name, survived ? "SURVIVED" : after.stage,
                 failed_before ? "FAILS WITHOUT IT: " + before.problem : first_line(after.problem));
      std::fflush(stdout);
      wrong += survived || failed_before;
    }
  }
  fmt::print("{} of {} faults, {} wrong\n", only.empty() ? named.size() : only.size(), named.size(), wrong);
  return wrong;
}

}  // namespace triptych::hard_cases
