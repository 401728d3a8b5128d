// Where surfaces of different instances meet, so that a gap between them would show.
#pragma once

#include "preprocess/parts.hpp"
#include "preprocess/placed_cache.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// Points within so many lattice steps of each other are in one place: files with single precision hold what
/// touches no closer (a lattice has 2^26 steps along its longest side).
inline constexpr double contact_steps = 16;

struct FoundContacts {
  std::vector<Contact> contacts;  ///< by placed part and point, each point once
  uint64_t crowded_parts = 0;     ///< ContactReport::crowded_parts
};

/// The contacts between the placed parts of a hierarchy; those of one instance among themselves are none.
///
/// A point is in contact where it lies on an edge at which the other surface ends or folds (PartRims): beyond
/// that edge nothing of the other surface would close the gap if the two moved apart. The end of the edge
/// that is there, or both if none is, is in contact as well. Where a point lies within a face that goes on
/// all around it, as the foot of a chair on a floor, that face closes the gap by itself: but not a side of a
/// rod (Cover::is_rod) for what is none, since levels may give up rods. There the point and the side's
/// corners are in contact, if neither of the two is more than four times as large as the other.
///
/// Of what is smaller than 8 times contact_steps no contacts are looked for: which points touch cannot be
/// told there. A part's contacts with at most 32 larger ones are found, among at most 1,024 whose boxes
/// overlap its own.
///
/// places: for each placed part that of its leaf. Reads the parts' geometry from the file; run on all cores.
/// `memory`: bytes that geometry may take at a time, roughly. kept: what earlier builds found.
FoundContacts find_contacts(const Parts& parts, const PlacedParts& hierarchy,
                            const std::vector<uint32_t>& places, const SpoolFile& geometry, uint64_t memory,
                            const PlacedCache& kept);

}  // namespace triptych
