#include "preprocess/contacts/hold_contacts.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// For each part the points in contact in any of its placements, ascending; border points are held anyway.
std::vector<std::vector<uint32_t>> points_in_contact(const Parts& parts, const SpoolFile& geometry) {
  std::vector<std::vector<uint32_t>> points(parts.parts.size());
  for (const PlacedParts& hierarchy : parts.hierarchies) {
    for (const Contact& contact : hierarchy.contacts)
      points[hierarchy.placed[contact.placed].part].push_back(contact.point);
  }
  for (size_t part = 0; part < points.size(); ++part) {
    std::vector<uint32_t>& own = points[part];
    if (own.empty()) continue;
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    for (const BorderPoint& border : load_borders(geometry, parts.parts[part])) {
      const auto found = std::lower_bound(own.begin(), own.end(), border.point);
      if (found != own.end() && *found == border.point) own.erase(found);
    }
  }
  return points;
}

}  // namespace

ContactReport hold_contacts(Parts& parts, std::vector<FoundContacts> contacts, const SpoolFile& geometry) {
  ContactReport report;
  for (size_t i = 0; i < contacts.size(); ++i) {
    report.contacts += contacts[i].contacts.size();
    report.crowded_parts += contacts[i].crowded_parts;
    parts.hierarchies[i].contacts = std::move(contacts[i].contacts);
  }
  std::vector<std::vector<uint32_t>> points = points_in_contact(parts, geometry);
  const size_t count = points.size();
  // Which placements are alone, and whether a part has such.
  std::vector<std::vector<uint8_t>> touches;
  std::vector<uint8_t> is_alone(count, 0);
  for (const PlacedParts& hierarchy : parts.hierarchies) {
    std::vector<uint8_t>& own = touches.emplace_back(hierarchy.placed.size(), 0);
    for (const Contact& contact : hierarchy.contacts) own[contact.placed] = 1;
    for (size_t i = 0; i < own.size(); ++i) {
      if (!own[i]) is_alone[hierarchy.placed[i].part] = 1;
    }
  }
  std::vector<uint32_t> chain(count);  // for each part the one whose levels hold its contacts
  for (uint32_t part = 0; part < count; ++part) {
    chain[part] = part;
    if (points[part].empty()) continue;
    ++report.held_parts;
    if (is_alone[part]) {
      ++report.added_chains;
      chain[part] = static_cast<uint32_t>(parts.parts.size());
      parts.parts.push_back(parts.parts[part]);
      parts.parts.back().variant_of = part;
    }
    parts.parts[chain[part]].contacts = std::move(points[part]);
  }
  for (size_t i = 0; i < parts.hierarchies.size(); ++i) {
    PlacedParts& hierarchy = parts.hierarchies[i];
    for (size_t k = 0; k < hierarchy.placed.size(); ++k) {
      if (touches[i][k]) hierarchy.placed[k].part = chain[hierarchy.placed[k].part];
    }
  }
  return report;
}

}  // namespace triptych
