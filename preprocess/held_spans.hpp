// For points that levels hold: which leaves of a hierarchy share or touch them.
#pragma once

#include "preprocess/build_work.hpp"
#include "preprocess/leaf_span.hpp"
#include "preprocess/parts.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// Of all placed parts of a hierarchy, in a file.
class HeldSpans {
 public:
  /// places: for each placed part that of its leaf. What is given must outlive it, but for these.
  HeldSpans(const Parts& parts, const PlacedParts& placed, const std::vector<uint32_t>& places,
            BuildWork& work);

  /// Of a placed part's held points: border points, then points in contact.
  std::vector<LeafSpan> load(uint32_t member) const;

 private:
  const Parts& parts_;
  const PlacedParts& placed_;
  BuildWork& work_;
  SpoolFile span_file_;
  std::vector<uint64_t> spans_;  ///< for each placed part where the spans of its held points begin
};

}  // namespace triptych
