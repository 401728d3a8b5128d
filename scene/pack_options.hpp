// How a pack was built, in the build's own words: the section OPTS. docs/pack-format.md describes every byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// By the name of the flag that asks for it, without its dashes ("keep", "bound"), what it was
/// ("cover,touching", "fast"). Only what decides what is in the pack. Empty: the pack does not say.
using PackOptions = std::map<std::string, std::string>;

/// A section is no longer than that.
inline constexpr uint64_t max_pack_options_bytes = 65536;

/// The section's bytes. Error for names and values that decode_pack_options() would refuse.
std::vector<std::byte> encode_pack_options(const PackOptions& options);
/// Error (place, byte) for bytes that are no such section, and where it has more than max_pack_options_bytes.
PackOptions decode_pack_options(std::span<const std::byte> bytes, const std::string& place);

/// Whether an option is a list with commas between that has this word.
bool has_word(const PackOptions& options, const std::string& option, std::string_view word);

}  // namespace triptych
