#include "launch/import_flags.hpp"

#include "base/error.hpp"
#include "launch/choice_flag.hpp"
#include "launch/number_flags.hpp"

#include <map>
#include <string>

namespace triptych {

namespace {

const std::map<std::string, UpAxis>& axes() {
  static const std::map<std::string, UpAxis> names = {{"y", UpAxis::y}, {"z", UpAxis::z}};
  return names;
}

const std::map<std::string, LengthUnit>& units() {
  static const std::map<std::string, LengthUnit> names = {{"m", LengthUnit::metre},
                                                          {"cm", LengthUnit::centimetre},
                                                          {"mm", LengthUnit::millimetre},
                                                          {"in", LengthUnit::inch},
                                                          {"ft", LengthUnit::foot}};
  return names;
}

}  // namespace

void add_import_flags(CLI::App& command, ImportOptions& options) {
  add_choice_flag(command, "--up", options.up, axes(),
                  "The axis that points up, for files that do not define it (OBJ, PLY, STL, OFF ...)")
      ->default_str("y");
  add_choice_flag(command, "--unit", options.unit, units(),
                  "The unit of length, for files that do not define it")
      ->default_str("m");
  command
      .add_option("--chord", options.chord,
                  "How far triangles may lie from the curved surfaces of STEP and IGES files, in metres")
      ->check(positive_number())
      ->default_str("a ten-thousandth of the size");
  command
      .add_option_function<std::string>(
          "--place",
          [&options](const std::string& words) {
            try {
              options.geo_place = parse_geo_place(words, "--place");
            } catch (const Error& error) {
              throw CLI::ValidationError(error.what());
            }
          },
          "Where on Earth the model stands, degrees north and east, with north at -z: for the sky that "
          "--date "
          "shows")
      ->type_name("LAT,LON")
      ->default_str("what an IFC file says");
}

std::vector<std::string> import_arguments(const ImportOptions& options) {
  std::vector<std::string> arguments;
  for (const auto& [name, axis] : axes()) {
    if (options.up == axis) arguments.insert(arguments.end(), {"--up", name});
  }
  for (const auto& [name, unit] : units()) {
    if (options.unit == unit) arguments.insert(arguments.end(), {"--unit", name});
  }
  if (options.chord) arguments.insert(arguments.end(), {"--chord", fmt::format("{}", *options.chord)});
  if (options.geo_place)
    arguments.insert(arguments.end(), {"--place", fmt::format("{},{}", options.geo_place->latitude,
                                                              options.geo_place->longitude)});
  return arguments;
}

std::string format_help() {
  std::string help = "Formats:";
  size_t width = help.size();
  for (const std::string& extension : known_extensions()) {
    if (width + extension.size() > 100) {
      help += "\n        ";
      width = 8;
    }
    help += " " + extension;
    width += extension.size() + 1;
  }
  return help;
}

}  // namespace triptych
