// What an image file claims about itself, read before any library is given it: decoders allocate by these
// claims.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace kilolux {

// What was expected of a header that would make its decoder hold far more than `maxBytes` at once or that
// exceeds `maxSizePx`; nothing for the rest, damaged files included, which the decoder refuses itself.
std::optional<std::string> complaintAboutClaims(std::span<const std::uint8_t> file, int maxSizePx,
                                                std::uint64_t maxBytes);

} // namespace kilolux
