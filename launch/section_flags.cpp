#include "launch/section_flags.hpp"

#include "base/error.hpp"
#include "scene/section_text.hpp"

#include <nlohmann/json.hpp>

namespace triptych {

namespace {

/// Wrong words on a command line are a usage error.
template <typename Body>
void as_usage(const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    throw CLI::ValidationError(error.what());
  }
}

}  // namespace

void add_section_flags(CLI::App& command, Section& section) {
  command
      .add_option_function<std::vector<std::string>>(
          "--section",
          [&section](const std::vector<std::string>& planes) {
            as_usage([&] {
              for (const std::string& words : planes)
                section.add_plane(read_section_plane(words, "--section"), "--section");
            });
          },
          "Show only this side of a plane, with cut surfaces of what is solid: x<12.5, or z>3, or NX,NY,NZ,D "
          "for the points p with normal · p >= D; up to six")
      ->type_name("PLANE")
      ->allow_extra_args(false);
  command
      .add_option_function<std::string>(
          "--section-box",
          [&section](const std::string& words) {
            as_usage([&] { section.set_box(read_section_box(words, "--section-box"), "--section-box"); });
          },
          "Show only what is in this box")
      ->type_name("X0,Y0,Z0,X1,Y1,Z1");
}

nlohmann::json section_json(const Section& section) {
  nlohmann::json planes = nlohmann::json::array();
  for (const SectionPlane& plane : section.planes()) {
    planes.push_back(
        {{"normal", {plane.normal.x, plane.normal.y, plane.normal.z}}, {"offset", plane.offset}});
  }
  nlohmann::json box = nullptr;
  if (section.box()) {
    const auto& [lo, hi] = *section.box();
    box = {lo.x, lo.y, lo.z, hi.x, hi.y, hi.z};
  }
  return {{"planes", planes}, {"box", box}};
}

}  // namespace triptych
