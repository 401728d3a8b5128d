// 3MF: a zip archive of XML parts.
#include "base/error.hpp"
#include "samples/kit/kit_files.hpp"
#include "samples/kit/kit_plan.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <minizip/zip.h>
#include <string_view>
#include <vector>

namespace triptych {

namespace {

constexpr const char* types =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)";

constexpr const char* relations =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" Target="/3D/3dmodel.model"/>
</Relationships>
)";

std::string object_of(const KitSolid& solid, size_t id, size_t material) {
  const KitMesh mesh = mesh_of(solid);
  std::string text =
      fmt::format("<object id=\"{}\" name=\"{}\" type=\"model\" pid=\"1\" pindex=\"{}\"><mesh><vertices>\n",
                  id, solid.name, material);
  for (const glm::dvec3& position : mesh.positions)
    text += fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", position.x, position.y, position.z);
  text += "</vertices><triangles>\n";
  for (const auto& [a, b, c] : mesh.triangles)
    text += fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", a, b, c);
  return text + "</triangles></mesh></object>\n";
}

std::string model_text() {
  std::vector<std::array<uint8_t, 3>> colours;
  std::string materials, objects, items;
  size_t id = 2;  // 1 is that of the materials
  for (const KitSolid& solid : kit_solids()) {
    auto known = std::find(colours.begin(), colours.end(), solid.colour);
    if (known == colours.end()) {
      const auto& [red, green, blue] = solid.colour;
      known = colours.insert(known, solid.colour);
      materials += fmt::format("<base name=\"{} {} {}\" displaycolor=\"#{:02X}{:02X}{:02X}\"/>\n", red, green,
                               blue, red, green, blue);
    }
    objects += object_of(solid, id, static_cast<size_t>(known - colours.begin()));
    items += fmt::format("<item objectid=\"{}\"/>\n", id++);
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"meter\" "
         "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<resources>\n"
         "<basematerials id=\"1\">\n" +
         materials + "</basematerials>\n" + objects + "</resources>\n<build>\n" + items +
         "</build>\n</model>\n";
}

bool add_part(zipFile archive, const char* name, std::string_view text) {
  zip_fileinfo info{};
  info.tmz_date = {.tm_sec = 0, .tm_min = 0, .tm_hour = 0, .tm_mday = 1, .tm_mon = 0, .tm_year = 1980};
  return zipOpenNewFileInZip(archive, name, &info, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED,
                             Z_DEFAULT_COMPRESSION) == ZIP_OK &&
         zipWriteInFileInZip(archive, text.data(), static_cast<unsigned>(text.size())) == ZIP_OK &&
         zipCloseFileInZip(archive) == ZIP_OK;
}

}  // namespace

void write_kit_3mf(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "kit.3mf";
  const zipFile archive = zipOpen64(file.c_str(), APPEND_STATUS_CREATE);
  if (!archive) fail(file.string(), "cannot be written");
  const bool written = add_part(archive, "[Content_Types].xml", types) &&
                       add_part(archive, "_rels/.rels", relations) &&
                       add_part(archive, "3D/3dmodel.model", model_text());
  if (zipClose(archive, nullptr) != ZIP_OK || !written) fail(file.string(), "cannot be written");
}

}  // namespace triptych
