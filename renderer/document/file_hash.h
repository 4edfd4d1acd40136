// A 64-bit fingerprint of bytes: tells whether a file is still the one that was read, and whether a record of
// the journal is whole. Against accidents, not against forgery. FNV-1a (Fowler, Noll, Vo) over 8-byte words,
// finished with the mixer of MurmurHash3 (Appleby).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace kilolux {

std::uint64_t hashBytes(std::string_view bytes);

// 16 hexadecimal digits, and back; false where the text is anything else.
std::string hashText(std::uint64_t hash);
bool parseHash(std::string_view text, std::uint64_t& hash);

} // namespace kilolux
