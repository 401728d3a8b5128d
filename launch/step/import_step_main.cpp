// triptych-import-step: reads one STEP or IGES file with OpenCASCADE, tessellates it, and writes a scene
// stream to descriptor 3 (docs/formats.md). A process of its own, since a damaged file may crash it or take
// all memory; triptych starts it (model/import/converter.hpp). "warning: ...", "progress: DONE TOTAL" and at
// most one "triptych: ..." go to standard error, one line each.
#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/one_line.hpp"
#include "launch/reader_limits.hpp"
#include "launch/step/step_scene.hpp"

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_ProgressIndicator.hxx>
#include <Message_ProgressScope.hxx>
#include <OSD.hxx>
#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <unistd.h>

namespace triptych {

namespace {

constexpr std::string_view name = "triptych-import-step";
constexpr size_t max_warnings = 40;

class ProgressLines : public Message_ProgressIndicator {
  DEFINE_STANDARD_RTTI_INLINE(ProgressLines, Message_ProgressIndicator)
 protected:
  void Show(const Message_ProgressScope& /*scope*/, bool /*force*/) override {
    if (since_line_.seconds() < 0.2) return;
    since_line_.restart();
    fmt::print(stderr, "progress: {} 1000\n", std::lround(1000 * GetPosition()));
  }

 private:
  Stopwatch since_line_;
};

std::string short_line(const std::string& text) { return one_line(text.substr(0, 160)); }

void convert(const std::string& file, std::optional<double> chord) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  const opencascade::handle<ProgressLines> indicator = new ProgressLines;
  Message_ProgressScope progress(indicator->Start(), "reading", 2);
  const StepDocument document = read_step_document(file, progress.Next());
  constexpr int output = 3;
  SceneWriter writer(output, "its temporary file", document.unit_is_defined ? unit_is_defined : 0);
  StepNotes notes;
  write_step_scene(document, chord, writer, notes, progress.Next());
  writer.end();
  std::vector<std::string> warnings = failed_lines(document);
  for (const auto& [what, count] : notes) warnings.push_back(fmt::format("{} {}", count, what));
  for (size_t i = 0; i < std::min(warnings.size(), max_warnings); ++i)
    fmt::print(stderr, "warning: {}\n", short_line(warnings[i]));
}

double chord_argument(std::string_view text) {
  double chord = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), chord);
  if (read.ec != std::errc() || !(chord > 0)) fail("--chord", "\"{}\" is not a length", text);
  return chord;
}

}  // namespace

}  // namespace triptych

int main(int count, char** arguments) {
  using namespace triptych;
  try {
    std::optional<double> chord;
    if (count == 6 && std::string_view(arguments[1]) == "--chord") {
      chord = chord_argument(arguments[2]);
      arguments += 2, count -= 2;
    }
    if (count != 4 || std::string_view(arguments[1]) != "--memory") {
      fmt::print(stderr,
                 "triptych: usage: triptych-import-step [--chord METRES] --memory BYTES FILE 3>FILE.scene\n");
      return 2;
    }
    limit_address_space(memory_argument(arguments[2]), name);
    // Faults become exceptions: what OpenCASCADE reads entity by entity goes on behind one that makes it
    // fault.
    OSD::SetSignal(Standard_False);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);  // nothing of what the libraries print is ours
    convert(arguments[3], chord);
    std::fflush(nullptr);
    ::_exit(0);  // destroying a large document takes time
  } catch (const Standard_OutOfMemory&) {
    end_out_of_memory();
  } catch (const Standard_Failure& failure) {
    fmt::print(stderr, "triptych: OpenCASCADE: {}\n", short_line(failure.GetMessageString()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "triptych: {}\n", short_line(error.what()));
  }
  std::fflush(nullptr);
  ::_exit(1);
}
