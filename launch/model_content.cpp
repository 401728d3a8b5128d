#include "launch/model_content.hpp"

#include "base/file_access.hpp"
#include "base/hashing.hpp"
#include "base/inject.hpp"
#include "base/shortest_names.hpp"
#include "model/import/import.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace triptych {

namespace {

/// The checksum of what is in the file, as text; "missing" where there is none.
std::string content_of(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return "missing";
  const Descriptor opened = open_to_read(file);
  StreamHash hash;
  read_in_stretches(opened.number(), size_of(opened.number(), file.string()), file.string(),
                    [&](std::span<const std::byte> bytes) { hash.add(bytes); });
  return fmt::format("{:016x}", hash.checksum());
}

/// Any name, also one that is no UTF-8, as JSON can hold it.
std::string in_ascii(const std::string& name) {
  std::string text;
  for (const char letter : name) {
    const auto byte = static_cast<unsigned char>(letter);
    text +=
        byte >= 0x20 && byte < 0x7f && letter != '%' ? std::string(1, letter) : fmt::format("%{:02x}", byte);
  }
  return text;
}

/// The other way about.
std::string from_ascii(const std::string& text) {
  std::string name;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      name += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      name += text[i];
    }
  }
  return name;
}

/// The programs that read further formats, beside this one (launch/CMakeLists.txt), and their scripts.
std::vector<std::filesystem::path> reader_files() {
  std::error_code error;
  const auto programs = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  const auto scripts = programs.parent_path() / "share/triptych/ifc";
  std::vector<std::filesystem::path> files = {programs / "triptych-import", programs / "triptych-import-ifc",
                                              programs / "triptych-import-step",
                                              scripts / "node_modules/web-ifc/web-ifc-api-node.js",
                                              scripts / "node_modules/web-ifc/web-ifc-node.wasm"};
  for (std::filesystem::directory_iterator entry(scripts, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() == ".mjs") files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

ContentKey key_of_readers() {
  ContentKeyWriter writer;
  for (const auto& reader : reader_files()) writer.write_all(std::span<const char>(content_of(reader)));
  return writer.key();
}

ModelContent::ModelContent(const BuildFlags& flags)
    : flags_(flags),
      folder_(std::filesystem::absolute(flags.inputs.front()).parent_path()),
      files_(files_of_models(flags.inputs)),
      key_(key_now()) {}

std::string ModelContent::name_of(const std::filesystem::path& file) const {
  return in_ascii(std::filesystem::absolute(file).lexically_relative(folder_).string());
}

std::filesystem::path ModelContent::file_of(const std::string& name) const {
  return folder_ / from_ascii(name);
}

std::string ModelContent::key_now() const {
  std::string key = "program " + content_of("/proc/self/exe") + "\n";
  for (const auto& reader : reader_files()) key += "reader " + content_of(reader) + "\n";
  for (const auto& [flag, value] : build_words(flags_)) key += flag + " " + value + "\n";
  for (const std::string& fault : injected_names()) key += "fault " + fault + "\n";
  for (const std::string& name : shortest_names(flags_.inputs)) key += "model " + in_ascii(name) + "\n";
  for (const auto& file : files_) key += content_of(file) + " " + name_of(file) + "\n";
  return key;
}

ModelContent::Files ModelContent::opened(const std::vector<std::string>& read) const {
  Files opened;
  for (const std::string& file : read) {
    const std::string name = name_of(file);
    const bool is_named =
        std::any_of(files_.begin(), files_.end(), [&](const auto& named) { return name_of(named) == name; });
    if (!is_named) opened[name] = content_of(file);
  }
  return opened;
}

bool ModelContent::still_holds(const Files& opened) const {
  return std::all_of(opened.begin(), opened.end(),
                     [&](const auto& file) { return content_of(file_of(file.first)) == file.second; });
}

}  // namespace triptych
