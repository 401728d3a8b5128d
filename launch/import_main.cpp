// triptych-import: reads one model file with Assimp and writes a .glb to descriptor 3. A process of its own,
// since Assimp crashes on some hostile files; triptych starts it (model/import/converter.hpp). Warnings and
// at most one error go to standard error, one line each, as "warning: ..." and "triptych: ...".
#include "base/error.hpp"
#include "base/one_line.hpp"
#include "launch/import_glb.hpp"
#include "launch/reader_limits.hpp"
#include "launch/x3d_text.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <assimp/config.h>
#include <assimp/metadata.h>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <locale>
#include <optional>
#include <set>
#include <stdexcept>
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
    if (is_false_alarm(text)) return;
    if (known_.size() < most && known_.insert(text).second)
      fmt::print(stderr, "warning: {}\n", short_line(text));
  }
  /// What Assimp says of files that are as they should be.
  static bool is_false_alarm(const std::string& text) {
    for (const char* harmless : {"no Definitions dictionary found", "setting default material",
                                 "Ignored file of", "unsupported type CONTENT_TYPES"}) {
      if (text.find(harmless) != std::string::npos) return true;
    }
    return false;
  }
  static std::string short_line(const std::string& text) { return one_line(text.substr(0, 160)); }

 private:
  static constexpr size_t most = 20;
  std::set<std::string> known_;
};

/// Says which files are opened beside the model: "reads: FILE".
class SaidFiles : public Assimp::DefaultIOSystem {
 public:
  explicit SaidFiles(std::string model) : model_(std::move(model)) {}
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    Assimp::IOStream* const stream = DefaultIOSystem::Open(file, mode);
    const std::string name(file);
    if (stream && name != model_ && name == one_line(name) && known_.insert(name).second)
      fmt::print(stderr, "reads: {}\n", name);
    return stream;
  }

 private:
  std::string model_;
  std::set<std::string> known_;
};

std::string lower_case(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

/// The file's bytes behind a UTF-8 byte order mark; nothing if it can be read where it is. Assimp takes the
/// mark for a part of the first word, except in XML. `unpacked`: the name does not say the format.
std::optional<std::string> bytes_to_read(const std::string& file, const std::string& extension,
                                         bool unpacked) {
  std::ifstream stream(file, std::ios::binary);
  std::string beginning(4, '\0');
  stream.read(beginning.data(), 4);
  const bool marked = beginning.starts_with("\xef\xbb\xbf") && beginning[3] != '<';
  const bool x3d = extension == ".x3d";
  if (!marked && !unpacked && !x3d) return std::nullopt;
  stream.clear();
  stream.seekg(marked ? 3 : 0);
  std::string bytes(std::istreambuf_iterator<char>(stream), {});
  if (!x3d) return bytes;
  // Files that it names are found only where it is read from its place.
  if (!marked && !unpacked && bytes.find("<Inline") != std::string::npos) return std::nullopt;
  return without_quotes_in_lists(bytes);
}

/// From the unit and axes of an FBX file, which Assimp does not apply itself, to metres and y up: the axis
/// that the file calls "coord" goes right, the one that it calls "front" comes forward.
glm::dmat3 fbx_to_model(const aiScene& scene) {
  double centimetres = 1;
  const auto number = [&](const char* name, int32_t otherwise) {
    int32_t value = otherwise;
    return scene.mMetaData && scene.mMetaData->Get(name, value) ? value : otherwise;
  };
  if (scene.mMetaData) {
    float single = 1;
    if (scene.mMetaData->Get("UnitScaleFactor", single)) centimetres = static_cast<double>(single);
    scene.mMetaData->Get("UnitScaleFactor", centimetres);
  }
  if (!std::isfinite(centimetres) || !(centimetres > 0)) centimetres = 1;
  struct Axis {
    int32_t axis, sign;
  };
  Axis up{number("UpAxis", 1), number("UpAxisSign", 1)};
  if (up.axis < 0 || up.axis > 2) up.axis = 1;
  Axis front{number("FrontAxis", 2), number("FrontAxisSign", 1)};
  Axis right{number("CoordAxis", 0), number("CoordAxisSign", 1)};
  const auto is_axis = [](const Axis& axis) { return axis.axis >= 0 && axis.axis <= 2; };
  if (!is_axis(front) || !is_axis(right) || front.axis == up.axis || right.axis == up.axis ||
      front.axis == right.axis) {  // only one axis is given: the others are what is usual with it
    front = up.axis == 2 ? Axis{1, -1} : Axis{2, 1};
    right = up.axis == 0 ? Axis{1, -1} : Axis{0, 1};
  }
  glm::dmat3 to_model(0);
  const auto point = [&](const Axis& from, int to) {
    to_model[from.axis][to] = (from.sign < 0 ? -1 : 1) * centimetres / 100;
  };
  point(right, 0), point(up, 1), point(front, 2);
  return to_model;
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

/// `unpacked_extension`: that of a file whose name does not have it; empty where it has.
void convert(const std::string& file, const std::string& unpacked_extension) {
  Assimp::DefaultLogger::create(nullptr, Assimp::Logger::NORMAL, 0);
  Assimp::DefaultLogger::get()->attachStream(new Warnings, Assimp::Logger::Warn | Assimp::Logger::Err);
  Assimp::Importer importer;
  importer.SetIOHandler(new SaidFiles(file));
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);  // else nodes have their ids
  const std::string extension = lower_case(
      unpacked_extension.empty() ? std::filesystem::path(file).extension().string() : unpacked_extension);
  const auto bytes = bytes_to_read(file, extension, !unpacked_extension.empty());
  const aiScene* scene =
      bytes ? importer.ReadFileFromMemory(bytes->data(), bytes->size(), 0,
                                          extension.substr(std::min<size_t>(1, extension.size())).c_str())
            : importer.ReadFile(file, 0);
  if (!scene) {
    const std::string why = importer.GetErrorString();
    if (why.find("bad_alloc") != std::string::npos) end_out_of_memory();
    throw std::runtime_error(fmt::format("is damaged, cut, or no {} file that Assimp can read; it says: {}",
                                         extension, Warnings::short_line(why)));
  }
  const glm::dmat3 to_model = extension == ".fbx" ? fbx_to_model(*scene) : glm::dmat3(1);
  ConversionNotes notes;
  if (scene->mNumAnimations > 0) notes["animations are not played"] = scene->mNumAnimations;
  constexpr int output = 3;
  write_glb(*scene, to_model, output, "Assimp's scene", notes);
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
    const bool unpacked = count == 6 && std::string_view(arguments[3]) == "--as";
    if ((count != 4 && !unpacked) || first != "--memory") {
      fmt::print(stderr,
                 "triptych: usage: triptych-import --memory BYTES [--as .EXTENSION] FILE 3>FILE.glb, or "
                 "--formats\n");
      return 2;
    }
    limit_address_space(memory_argument(arguments[2]), "triptych-import");
    convert(arguments[count - 1], unpacked ? arguments[4] : "");
    std::fflush(nullptr);
    ::_exit(0);  // destroying a large scene takes time, and Assimp leaks memory
  } catch (const std::exception& error) {
    fmt::print(stderr, "triptych: {}\n", Warnings::short_line(error.what()));
    return 1;
  }
}
