// IFC by web-ifc, STEP and IGES by OpenCASCADE, each in a process of its own that writes a scene stream.
#include "model/import/converter.hpp"
#include "model/import/import_file.hpp"
#include "model/import/kept_conversions.hpp"
#include "model/import/mesh_stream_source.hpp"

#include <algorithm>

namespace triptych {

namespace {

std::shared_ptr<const StreamSource> source_of(const FileImport& target) {
  const PackedFile* const unpacked = target.unpacked();
  return unpacked ? unpacked->content : std::make_shared<const StreamSource>(target.file());
}

/// What decides, beside the bytes of the file, what the converter makes of it.
std::string words_of(const FileImport& target, const Converter& converter) {
  const ImportOptions& options = target.options();
  std::string words = fmt::format("{}\n{}\n{}\n{}\n", converter.program, options.converter.string(),
                                  target.model_name().extension().string(), options.converter_bytes);
  for (const std::string& flag : converter.flags) words += flag + "\n";
  return words;
}

void import_with(FileImport& target, const Converter& converter) {
  const ImportOptions& options = target.options();
  const auto convert = [&] { return convert_model(target.file(), target.unpacked(), options, converter); };
  KeptConversions* const kept = options.kept_conversions;
  Converted converted =
      kept ? kept->get(source_of(target), words_of(target, converter), options.temporary_folder, convert)
           : convert();
  for (std::string& warning : converted.warnings) target.remark(std::move(warning));
  import_scene(target, std::move(converted.output));
}

/// Whether a STEP file's header names a schema of IFC, which some programs write under that name.
bool holds_ifc(const FileImport& target) {
  constexpr size_t header_bytes = 16384;
  const auto source = source_of(target);
  std::string header(std::min<uint64_t>(header_bytes, source->size()), ' ');
  SourceReader(source).read(0, std::as_writable_bytes(std::span(header)));
  const size_t schema = header.find("FILE_SCHEMA");
  return schema != std::string::npos && header.substr(schema, 100).find("IFC") != std::string::npos;
}

}  // namespace

void import_ifc(FileImport& target) { import_with(target, {"triptych-import-ifc", "web-ifc", {}}); }

void import_step(FileImport& target) {
  if (holds_ifc(target)) return import_ifc(target);
  Converter converter{"triptych-import-step", "OpenCASCADE", {}};
  if (const auto chord = target.options().chord) converter.flags = {"--chord", fmt::format("{}", *chord)};
  import_with(target, converter);
}

}  // namespace triptych
