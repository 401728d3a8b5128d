// triptych-sample-kit: writes the sample `kit` (samples/kit/kit_plan.hpp) in one of the formats that Assimp
// or OpenCASCADE export. `triptych sample kit` starts it, so that it links neither of them itself.
#include "base/error.hpp"
#include "base/one_line.hpp"
#include "launch/kit/kit_assimp.hpp"
#include "launch/kit/kit_step.hpp"

#include <Standard_Failure.hxx>
#include <cstdio>
#include <locale>
#include <unistd.h>

namespace triptych {

namespace {

void complain(const std::string& what) {
  fmt::print(stderr, "triptych: {}\n", one_line(what.substr(0, 160)));
}

void write(const std::string& format, const std::filesystem::path& file) {
  if (assimp_writes(format)) return write_kit_with_assimp(format, file);
  if (opencascade_writes(format)) return write_kit_with_opencascade(format, file);
  fail("triptych-sample-kit", "cannot write the format \"{}\"", format);
}

}  // namespace

}  // namespace triptych

int main(int count, char** arguments) {
  using namespace triptych;
  std::locale::global(std::locale::classic());  // numbers have a decimal point
  try {
    if (count != 3) {
      complain("usage: triptych-sample-kit FORMAT FILE");
      return 2;
    }
    write(arguments[1], arguments[2]);
    ::_exit(0);  // OpenCASCADE keeps what it made until the process ends
  } catch (const Standard_Failure& failure) {
    complain(std::string("OpenCASCADE: ") + failure.GetMessageString());
  } catch (const std::exception& error) {
    complain(error.what());
  }
  return 1;
}
