#include "base/error.hpp"
#include "view/bcf/bcf.hpp"
#include "view/bcf/xml_tree.hpp"
#include "view/bcf/zip_file.hpp"

#include <array>
#include <glm/geometric.hpp>
#include <random>

namespace triptych {

namespace {

constexpr const char* xml_begin = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

/// A random one (version 4 of RFC 4122).
std::string new_guid() {
  std::random_device random;
  std::array<uint32_t, 4> bits = {random(), random(), random(), random()};
  bits[1] = (bits[1] & 0xffff0fff) | 0x4000;
  bits[2] = (bits[2] & 0x3fffffff) | 0x80000000;
  return fmt::format("{:08x}-{:04x}-{:04x}-{:04x}-{:04x}{:08x}", bits[0], bits[1] >> 16, bits[1] & 0xffff,
                     bits[2] >> 16, bits[2] & 0xffff, bits[3]);
}

/// The pack's y up to BCF's z up.
std::string vector_text(const char* name, const glm::dvec3& model) {
  // 0 + −0 is 0, which is easier to read.
  return fmt::format("<{0}><X>{1}</X><Y>{2}</Y><Z>{3}</Z></{0}>\n", name, 0 + model.x, 0 - model.z,
                     0 + model.y);
}

std::string components_text(const char* name, const std::vector<std::string>& guids) {
  if (guids.empty()) return "";
  std::string text = fmt::format("<{}>", name);
  for (const std::string& guid : guids) text += fmt::format("<Component IfcGuid=\"{}\"/>", xml_text(guid));
  return text + fmt::format("</{}>\n", name);
}

std::string view_text(const Viewpoint& viewpoint, const std::string& guid) {
  const PathFrame& frame = viewpoint.camera;
  std::string text = xml_begin + fmt::format("<VisualizationInfo Guid=\"{}\">\n<Components>\n", guid);
  text += components_text("Selection", viewpoint.selected);
  text += fmt::format("<Visibility DefaultVisibility=\"{}\">{}</Visibility>\n</Components>\n",
                      viewpoint.shows_others, components_text("Exceptions", viewpoint.exceptions));
  const char* const camera = frame.orthographic_height ? "OrthogonalCamera" : "PerspectiveCamera";
  // Both at right angles, as readers expect it.
  const glm::dvec3 direction = glm::normalize(frame.target - frame.eye);
  const glm::dvec3 up = glm::normalize(frame.up - glm::dot(frame.up, direction) * direction);
  text += fmt::format("<{}>\n", camera) + vector_text("CameraViewPoint", frame.eye) +
          vector_text("CameraDirection", direction) + vector_text("CameraUpVector", up);
  text += frame.orthographic_height
              ? fmt::format("<ViewToWorldScale>{}</ViewToWorldScale>\n", *frame.orthographic_height)
              : fmt::format("<FieldOfView>{}</FieldOfView>\n", frame.fov_y_degrees);
  text += fmt::format("</{}>\n", camera);
  if (!viewpoint.planes.empty()) {
    text += "<ClippingPlanes>\n";
    for (const SectionPlane& plane : viewpoint.planes) {
      text += "<ClippingPlane>\n" + vector_text("Location", plane.normal * plane.offset) +
              vector_text("Direction", -plane.normal) + "</ClippingPlane>\n";
    }
    text += "</ClippingPlanes>\n";
  }
  return text + "</VisualizationInfo>\n";
}

std::string markup_text(const Viewpoint& viewpoint, const std::string& topic, const std::string& guid,
                        bool has_snapshot, const std::string& time) {
  return xml_begin + fmt::format(
                         "<Markup>\n<Topic Guid=\"{}\" TopicType=\"Viewpoint\" TopicStatus=\"Open\">\n"
                         "<Title>{}</Title>\n<CreationDate>{}</CreationDate>\n"
                         "<CreationAuthor>triptych</CreationAuthor>\n</Topic>\n"
                         "<Viewpoints Guid=\"{}\">\n<Viewpoint>viewpoint.bcfv</Viewpoint>\n{}</Viewpoints>\n"
                         "</Markup>\n",
                         topic, xml_text(viewpoint.title), time, guid,
                         has_snapshot ? "<Snapshot>snapshot.png</Snapshot>\n" : "");
}

}  // namespace

void write_bcf(const std::filesystem::path& file, const Viewpoint& viewpoint,
               std::span<const std::byte> snapshot, const std::string& time) {
  if (viewpoint.camera.off_axis) fail(file.string(), "BCF has no off-axis cameras");
  const std::string topic = new_guid(), guid = new_guid();
  ZipWriter zip(file);
  zip.add("bcf.version", xml_begin + std::string("<Version VersionId=\"2.1\">"
                                                 "<DetailedVersion>2.1</DetailedVersion></Version>\n"));
  zip.add(topic + "/", std::string());
  zip.add(topic + "/markup.bcf", markup_text(viewpoint, topic, guid, !snapshot.empty(), time));
  zip.add(topic + "/viewpoint.bcfv", view_text(viewpoint, guid));
  if (!snapshot.empty()) zip.add(topic + "/snapshot.png", snapshot);
  zip.commit();
}

}  // namespace triptych
