// Viewpoint files: bytes as an archive, or as the members of one, since random changes hardly ever get
// through its checksums.
#include "base/error.hpp"
#include "fuzz_target.hpp"
#include "view/bcf/bcf.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>
#include <zlib.h>

namespace triptych::fuzz {

namespace {

void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz target: %s\n", what);
  std::abort();
}

class Bytes {
 public:
  void number(uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) all.push_back(i < 4 ? static_cast<uint8_t>(value >> 8 * i) : uint8_t{0});
  }
  void text(const std::string& text) { all.insert(all.end(), text.begin(), text.end()); }
  std::vector<uint8_t> all;
};

/// The members, not compressed.
std::vector<uint8_t> archive_of(const std::array<std::string, 3>& texts) {
  constexpr std::array<const char*, 3> names = {"bcf.version", "t/markup.bcf", "t/a.bcfv"};
  Bytes file, directory;
  for (size_t i = 0; i < texts.size(); ++i) {
    const auto begin = static_cast<uint32_t>(file.all.size());
    const std::string& text = texts[i];
    const auto size = static_cast<uint32_t>(text.size());
    const auto check =
        static_cast<uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(size)));
    const auto both = [&](Bytes& to) {  // from the version to the length of what is extra
      to.number(20, 2);
      to.number(0, 8);
      for (const uint32_t number : {check, size, size}) to.number(number, 4);
      to.number(static_cast<uint32_t>(std::string(names[i]).size()), 2);
      to.number(0, 2);
    };
    file.number(0x04034b50, 4);
    both(file);
    file.text(names[i]);
    file.text(text);
    directory.number(0x02014b50, 4);
    directory.number(20, 2);
    both(directory);
    directory.number(0, 4);
    directory.number(0, 2);
    directory.number(0, 4);
    directory.number(begin, 4);
    directory.text(names[i]);
  }
  const auto begin = static_cast<uint32_t>(file.all.size()),
             size = static_cast<uint32_t>(directory.all.size());
  file.all.insert(file.all.end(), directory.all.begin(), directory.all.end());
  file.number(0x06054b50, 4);
  file.number(0, 4);
  file.number(static_cast<uint32_t>(texts.size()), 2);
  file.number(static_cast<uint32_t>(texts.size()), 2);
  file.number(size, 4);
  file.number(begin, 4);
  file.number(0, 2);
  return file.all;
}

bool is_finite(const glm::dvec3& vector) {
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

void check(const Viewpoint& viewpoint) {
  const PathFrame& camera = viewpoint.camera;
  expect(is_finite(camera.eye) && is_finite(camera.target) && is_finite(camera.up), "a camera is not finite");
  expect(!(camera.eye == camera.target), "a camera looks nowhere");
  for (const SectionPlane& plane : viewpoint.planes)
    expect(std::abs(glm::length(plane.normal) - 1) < 1e-9, "a plane's normal has another length than 1");
  try {
    const Section section = section_of(viewpoint, "fuzz");
    expect(planes_of(section).size() == viewpoint.planes.size(), "a section has lost a plane");
  } catch (const Error&) {  // too many of them
  }
}

void read(std::span<const uint8_t> bytes) {
  try {
    const std::vector<Viewpoint> viewpoints = read_bcf(file_of(bytes));
    expect(!viewpoints.empty(), "a file without viewpoints is read");
    for (const Viewpoint& viewpoint : viewpoints) check(viewpoint);
  } catch (const Error& error) {
    expect(std::string(error.what()).find('\n') == std::string::npos, "an error has several lines");
  }
}

}  // namespace

}  // namespace triptych::fuzz

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace triptych::fuzz;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (text.starts_with("PK")) {
    read({data, size});
    return 0;
  }
  // Three members, with a zero byte between them.
  std::array<std::string, 3> members;
  size_t begin = 0;
  for (size_t i = 0; i < members.size() && begin <= text.size(); ++i) {
    const size_t end = i + 1 == members.size() ? text.size() : std::min(text.find('\0', begin), text.size());
    members[i] = text.substr(begin, end - begin);
    begin = end + 1;
  }
  read(archive_of(members));
  return 0;
}
