#include "preprocess/held_spans.hpp"

#include "base/bytes.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace triptych {

HeldSpans::HeldSpans(const Parts& parts, const PlacedParts& placed_parts, const std::vector<uint32_t>& places,
                     BuildWork& work)
    : parts_(parts), placed_(placed_parts), work_(work), span_file_(work.file("spans")) {
  std::vector<size_t> first;  // for each instance
  size_t count = 0;
  for (const uint32_t borders : placed_.border_counts) {
    first.push_back(count);
    count += borders;
  }
  std::vector<size_t> own_first;  // for each placed part
  for (const PlacedPart& placed : placed_.placed) {
    own_first.push_back(count);
    count += parts_.parts[placed.part].contacts.size();
  }
  if (count == 0) return;
  std::vector<LeafSpan> spans(count);  // by instance, by number; then by placed part, by contact point
  constexpr float unlimited = std::numeric_limits<float>::infinity();
  const auto each_held = [&](uint32_t member, const auto& take) {
    const PlacedPart& placed = placed_.placed[member];
    const PartInfo& part = parts_.parts[placed.part];
    if (part.borders > 0) {
      for (const BorderPoint& border : load_borders(work_.parts(), part))
        take(border.point, spans[first[placed.instance] + border.number], unlimited);
    }
    for (size_t i = 0; i < part.contacts.size(); ++i) take(part.contacts[i], spans[own_first[member] + i], 0);
  };
  for (uint32_t member = 0; member < places.size(); ++member) {
    each_held(member, [&](uint32_t point, LeafSpan& span, float reach) {
      span.extend({places[member], places[member], reach});
      const auto found =
          std::lower_bound(placed_.contacts.begin(), placed_.contacts.end(), std::pair(member, point),
                           [](const Contact& a, const std::pair<uint32_t, uint32_t>& key) {
                             return std::pair(a.placed, a.point) < key;
                           });
      if (found != placed_.contacts.end() && found->placed == member && found->point == point)
        span.extend(found->span);
    });
  }
  std::vector<LeafSpan> own;
  for (uint32_t member = 0; member < places.size(); ++member) {
    own.clear();
    each_held(member, [&](uint32_t, const LeafSpan& span, float) { own.push_back(span); });
    spans_.push_back(own.empty() ? 0 : span_file_.append(std::as_bytes(std::span(own))).offset);
  }
}

std::vector<LeafSpan> HeldSpans::load(uint32_t member) const {
  const PartInfo& part = parts_.parts[placed_.placed[member].part];
  const size_t count = part.borders + part.contacts.size();
  if (count == 0) return {};
  const std::vector<std::byte> bytes = span_file_.read({spans_[member], count * sizeof(LeafSpan)});
  return ByteReader(bytes, span_file_.path().string()).read_all<LeafSpan>(count);
}

}  // namespace triptych
