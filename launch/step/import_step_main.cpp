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
#include <filesystem>
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

void convert(const std::filesystem::path& file, const std::string& extension, std::optional<double> chord) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  const opencascade::handle<ProgressLines> indicator = new ProgressLines;
  Message_ProgressScope progress(indicator->Start(), "reading", 2);
  const StepDocument document = read_step_document(file, extension, progress.Next());
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
    const auto flags = reader_flags(count, arguments, {"--memory", "--chord", "--as"});
    if (!flags) {
      fmt::print(
          stderr,
          "triptych: usage: triptych-import-step --memory BYTES [--chord METRES] [--as .EXTENSION] FILE "
          "3>FILE.scene\n");
      return 2;
    }
    std::optional<double> chord;
    if (flags->count("--chord") > 0) chord = chord_argument(flags->at("--chord"));
    const std::filesystem::path file = arguments[count - 1];
    const std::string extension = flags->count("--as") > 0 ? flags->at("--as") : file.extension().string();
    limit_address_space(memory_argument(flags->at("--memory")), name);
    // Faults become exceptions: what OpenCASCADE reads entity by entity goes on behind one that makes it
    // fault.
    OSD::SetSignal(Standard_False);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);  // nothing of what the libraries print is ours
    convert(file, extension, chord);
    std::fflush(nullptr);
    ::_exit(0);  // destroying a large document takes time
  } catch (const Standard_OutOfMemory&) {
    end_out_of_memory();
  } catch (const Standard_Failure& failure) {
    const std::string why = failure.GetMessageString();
    fmt::print(stderr, "triptych: is damaged, or holds what OpenCASCADE cannot read{}\n",
               why.empty() ? "" : "; it says: " + short_line(why));
  } catch (const std::exception& error) {
    fmt::print(stderr, "triptych: {}\n", short_line(error.what()));
  }
  std::fflush(nullptr);
  ::_exit(1);
}
