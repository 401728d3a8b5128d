// triptych-import: reads one model file with Assimp and writes a .glb to descriptor 3. A process of its own,
// since Assimp crashes on some hostile files; triptych starts it (model/import/converter.hpp). Warnings and
// at most one error go to standard error, one line each, as "warning: ..." and "triptych: ...".
#include "base/error.hpp"
#include "base/one_line.hpp"
#include "launch/import_glb.hpp"
#include "launch/reader_limits.hpp"

#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <assimp/metadata.h>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <locale>
#include <set>
#include <string_view>
#include <unistd.h>

namespace triptych {

namespace {

/// Prints Assimp's warnings, each once.
class Warnings : public Assimp::LogStream {
 public:
  void write(const char* message) override {
    std::string text(message);
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    // "Warn,  T4321: what"
    if (const size_t colon = text.find(": "); colon != std::string::npos) text.erase(0, colon + 2);
    if (known_.size() < most && known_.insert(text).second)
      fmt::print(stderr, "warning: {}\n", short_line(text));
  }
  static std::string short_line(const std::string& text) { return one_line(text.substr(0, 160)); }

 private:
  static constexpr size_t most = 20;
  std::set<std::string> known_;
};

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return extension;
}

/// The unit and axes of an FBX file, which Assimp does not apply itself.
struct FbxConvention {
  double metres = 1;
  bool z_up = false;
};

FbxConvention fbx_convention(const aiScene& scene) {
  FbxConvention convention{0.01, false};
  if (!scene.mMetaData) return convention;
  double centimetres = 1;
  float single = 1;
  if (scene.mMetaData->Get("UnitScaleFactor", single)) centimetres = static_cast<double>(single);
  scene.mMetaData->Get("UnitScaleFactor", centimetres);
  if (std::isfinite(centimetres) && centimetres > 0) convention.metres = centimetres / 100;
  int32_t up = 1;
  convention.z_up = scene.mMetaData->Get("UpAxis", up) && up == 2;
  return convention;
}

void note_precision(const aiScene& scene) {
  const double largest = largest_coordinate_of(scene);
  const float single = static_cast<float>(largest);
  const float next = std::nextafter(single, std::numeric_limits<float>::max());
  fmt::print(
      stderr,
      "warning: coordinates went through single precision: the largest is {:.9g}, where a step is {:.3g} "
      "(in the file's unit)\n",
      largest, static_cast<double>(next) - static_cast<double>(single));
}

void convert(const std::string& file) {
  Assimp::DefaultLogger::create(nullptr, Assimp::Logger::NORMAL, 0);
  Assimp::DefaultLogger::get()->attachStream(new Warnings, Assimp::Logger::Warn | Assimp::Logger::Err);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file, 0);
  if (!scene) {
    const std::string why = importer.GetErrorString();
    if (why.find("bad_alloc") != std::string::npos) end_out_of_memory();
    fail("Assimp", "{}", Warnings::short_line(why));
  }
  const FbxConvention convention = extension_of(file) == ".fbx" ? fbx_convention(*scene) : FbxConvention{};
  ConversionNotes notes;
  if (scene->mNumAnimations > 0) notes["animations are not played"] = scene->mNumAnimations;
  constexpr int output = 3;
  write_glb(*scene, convention.metres, convention.z_up, output, "Assimp's scene", notes);
  note_precision(*scene);
  for (const auto& [what, count] : notes) fmt::print(stderr, "warning: {} {}\n", count, what);
}

void print_formats() {
  aiString extensions;
  Assimp::Importer().GetExtensionList(extensions);
  fmt::print("{}\n", extensions.C_Str());
}

}  // namespace

}  // namespace triptych

int main(int count, char** arguments) {
  using namespace triptych;
  std::locale::global(std::locale::classic());  // numbers have a decimal point
  try {
    const std::string_view first = count > 1 ? arguments[1] : "";
    if (count == 2 && first == "--formats") {
      print_formats();
      return 0;
    }
    if (count != 4 || first != "--memory") {
      fmt::print(stderr, "triptych: usage: triptych-import --memory BYTES FILE 3>FILE.glb, or --formats\n");
      return 2;
    }
    limit_address_space(memory_argument(arguments[2]), "triptych-import");
    convert(arguments[3]);
    std::fflush(nullptr);
    ::_exit(0);  // destroying a large scene takes time, and Assimp leaks memory
  } catch (const std::exception& error) {
    fmt::print(stderr, "triptych: {}\n", Warnings::short_line(error.what()));
    return 1;
  }
}
