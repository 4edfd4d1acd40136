#include "renderer/document/file_hash.h"

#include <charconv>
#include <cstring>
#include <fmt/format.h>

namespace kilolux {

std::uint64_t hashBytes(std::string_view bytes) {
    constexpr std::uint64_t kOffset = 0xCBF29CE484222325ull, kPrime = 0x100000001B3ull;
    std::uint64_t hash = kOffset ^ bytes.size();
    const auto take = [&](std::uint64_t word) {
        hash = (hash ^ word) * kPrime;
        hash ^= hash >> 32; // FNV's product never carries downwards
    };
    std::size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + i, 8);
        take(word);
    }
    for (; i < bytes.size(); ++i)
        take(static_cast<unsigned char>(bytes[i]));
    hash = (hash ^ (hash >> 33)) * 0xFF51AFD7ED558CCDull;
    hash = (hash ^ (hash >> 33)) * 0xC4CEB9FE1A85EC53ull;
    return hash ^ (hash >> 33);
}

std::string hashText(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

bool parseHash(std::string_view text, std::uint64_t& hash) {
    if (text.size() != 16) return false;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
    return error == std::errc() && end == text.data() + text.size();
}

} // namespace kilolux
