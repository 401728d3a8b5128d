// In a program that speaks a language with a decimal comma, or that rounds otherwise, the same files give the
// same bytes.
#include "base/file.hpp"
#include "model/import/import.hpp"
#include "preprocess/build.hpp"
#include "preprocess/check/check.hpp"
#include "scene/pack.hpp"
#include "scene/path.hpp"
#include "tests/session/program.hpp"

#include <cfenv>
#include <clocale>
#include <cmath>
#include <locale>

namespace triptych {
namespace {

using test::text_of;

/// Numbers with points, with exponents and beyond the range of doubles.
const std::vector<std::pair<std::string, std::string>> models = {
    {"model.obj",
     "v 0.5 0.25 0.125\nv 1.5 0.25 0.125\nv 0.5 1.25 1.5e-400\nf 1 2 3\n"
     "o other\nv 1234.567 0.1 0.7\nv 1235.567 0.3 0.3\nv 1234.567 1.1 1.1e-1\nf 4 5 6\n"},
    {"model.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
     "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
     "0.5 0.1 0.7\n1.5 0.25 1.5e-400\n0.5 1.25 1e-1\n3 0 1 2\n"},
    {"model.stl",
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0.5 0.1 0.7\nvertex 1.5 0.25 0.125\n"
     "vertex 0.5 1.25 1.5e-400\nendloop\nendfacet\nendsolid a\n"},
    {"model.gltf",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": [1234.567, 0.1, 1.5e-1], "scale": [1.1, 1, 1]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
     R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})"},
    // By Assimp, in a process of its own.
    {"model.dxf",
     "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\n0\n10\n0.5\n20\n0.1\n30\n0.7\n11\n1.5\n21\n0.25\n31\n0.125\n"
     "12\n0.5\n22\n1.25\n32\n0.75\n13\n0.5\n23\n1.25\n33\n0.75\n0\nENDSEC\n0\nEOF\n"},
};

const std::string walk =
    R"({"triptych_path": 1, "fov_y_degrees": 60.5, "frames": [)"
    R"({"eye": [3.5, 3.25, 3.1], "target": [0.75, 0.5, 0.125], "up": [0, 0, 1], "near": 0.015},)"
    R"({"eye": [3.1, 3, 3], "target": [1, 1.1, 0], "up": [0, 0.1, 1], "time_seconds": 0.5}]})";

/// Everything that the library reads and writes, as bytes.
std::vector<std::string> outcome(const test::Folder& folder) {
  std::vector<std::string> found;
  for (const auto& [name, text] : models) {
    if (name == "model.dxf") continue;  // another program's
    write_file(folder.file(name), text);
    const std::string pack = folder.file("pack.tpk");
    build_pack(import_model({folder.file(name)}), {}, pack);
    found.push_back(text_of(pack));
    const CheckReport report = check_pack(Pack(pack));
    EXPECT_TRUE(report.sound()) << name;
  }
  const std::string path = folder.file("walk.json");
  write_file(path, walk);
  nlohmann::json numbers;
  for (const PathFrame& frame : load_path(path).frames) {
    for (const glm::dvec3& v : {frame.eye, frame.target, frame.up}) numbers.push_back({v.x, v.y, v.z});
    numbers.push_back(frame.near.value_or(0));
  }
  found.push_back(numbers.dump());
  return found;
}

/// The whole process in German, as long as it lives.
class InGerman {
 public:
  InGerman() {
    ::setenv("LOCPATH", LOCALES, 1);
    std::locale::global(std::locale("de_DE.UTF-8"));
  }
  ~InGerman() { std::locale::global(std::locale::classic()); }
  InGerman(const InGerman&) = delete;
  InGerman& operator=(const InGerman&) = delete;
};

TEST(Languages, files_and_paths_are_read_and_written_alike_in_one_with_a_decimal_comma) {
  const test::Folder folder;
  const std::vector<std::string> plain = outcome(folder);
  const InGerman german;
  ASSERT_STREQ(std::localeconv()->decimal_point, ",");
  EXPECT_EQ(outcome(folder), plain);
}

TEST(Languages, files_and_paths_are_read_and_written_alike_under_every_rounding_mode_which_stays) {
  const test::Folder folder;
  const std::vector<std::string> plain = outcome(folder);
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const std::vector<std::string> found = outcome(folder);
    EXPECT_EQ(std::fegetround(), mode);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(found, plain) << mode;
  }
}

/// What the program makes of the models, with a library in it that has set the user's language.
std::vector<std::string> outcome_of_program(const test::Folder& folder, const std::string& language) {
  ::setenv("LC_ALL", language.c_str(), 1);
  ::setenv("LOCPATH", LOCALES, 1);
  ::setenv("LD_PRELOAD", GERMAN_HOST, 1);
  std::vector<std::string> found;
  const auto run = [&](const std::vector<std::string>& arguments) {
    test::Program program(arguments);
    EXPECT_EQ(program.wait(), 0) << program.errors();
  };
  const std::string pack = folder.file("pack.tpk"), path = folder.file("walk.json");
  for (const auto& [name, text] : models) {
    write_file(folder.file(name), text);
    run({"build", folder.file(name), "-o", pack});
    found.push_back(text_of(pack));
  }
  write_file(path, walk);
  const std::string check = folder.file("check.json");
  run({"check", pack, "--json", check});
  found.push_back(text_of(check));
  run({"render", pack, "--path", path, "--pixel-error", "0.5", "--size", "40x30", "-o",
       folder.file(language)});
  found.push_back(text_of(folder.file(language) + "/000000.png"));
  // One session for both: times differ.
  if (language == "C") {
    run({"measure", "session", pack, "--path", path, "--size", "40x30", "--pixel-error", "0.5", "--json",
         folder.file("session.json")});
    write_file(folder.file("manifest.json"),
               R"({"title": "Two languages", "entries": [{"name": "session", "json": "session.json",
                  "command": "measure session"}], "pictures": []})");
  }
  run({"report", folder.file("manifest.json"), "-o", folder.file("report")});
  for (const char* name : {"/report.html", "/report.json"})
    found.push_back(text_of(folder.file("report") + name));
  for (const char* name : {"LC_ALL", "LOCPATH", "LD_PRELOAD"}) ::unsetenv(name);
  return found;
}

TEST(Languages, the_program_speaks_none) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer's library wants to be the first";
#endif
  const test::Folder folder;
  const std::vector<std::string> plain = outcome_of_program(folder, "C");
  const std::vector<std::string> german = outcome_of_program(folder, "de_DE.UTF-8");
  ASSERT_EQ(german.size(), plain.size());
  for (size_t i = 0; i < plain.size(); ++i) {
    EXPECT_GT(plain[i].size(), 50u) << i;
    EXPECT_TRUE(german[i] == plain[i]) << i;
  }
}

}  // namespace
}  // namespace triptych
