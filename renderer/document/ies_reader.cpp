// Reads LM-63 files: label lines, tilt, thirteen numbers, two lists of angles, and the table of intensities.
// Strict about what decides the light, lenient about labels, separators and what follows the table, as real
// files differ there.
#include "renderer/document/ies_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>

namespace kilolux {

namespace {

constexpr std::size_t kMostAngles = 100'000;
constexpr std::uintmax_t kMostBytes = 16u << 20u;
constexpr double kMetresPerFoot = 0.3048;
constexpr double kMostEfficiency = 1.05; // of relative photometry: rounded tables exceed 1 a little

std::string_view trimmed(std::string_view s) {
    const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    while (!s.empty() && blank(s.front()))
        s.remove_prefix(1);
    while (!s.empty() && blank(s.back()))
        s.remove_suffix(1);
    return s;
}

// For messages: what a terminal shows, and not too much of it.
std::string printable(std::string_view s) {
    std::string out;
    for (const char c : s.substr(0, 40))
        out += c >= ' ' && c <= '~' ? c : '?';
    return s.size() > 40 ? out + "..." : out;
}

class Reader {
  public:
    Reader(std::string_view text, const std::string& path) : rest_(text), path_(path) {
        if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
    }

    Error error(const std::string& message) const {
        return Error{fmt::format("{}:{}: {}", path_, line_, message)};
    }

    // The next line without its end; false behind the last one.
    bool nextLine(std::string_view& line) {
        if (rest_.empty()) return false;
        ++line_;
        const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
        line = rest_.substr(0, end);
        const bool crLf = rest_.substr(end).starts_with("\r\n");
        rest_.remove_prefix(std::min(end + (crLf ? 2 : 1), rest_.size()));
        return true;
    }

    // The next number; separators are blanks, line ends and commas. `what` names it in errors.
    bool number(double& value, std::string_view what) {
        while (tokens_.empty()) {
            std::string_view line;
            if (!nextLine(line)) return fail(fmt::format("expected {}, the file ends", what));
            tokens_ = skipSeparators(line);
        }
        const std::size_t end = std::min(tokens_.find_first_of(" \t\v\f,"), tokens_.size());
        const std::string_view token = tokens_.substr(0, end);
        tokens_ = skipSeparators(tokens_.substr(end));
        const std::string_view digits = token.starts_with('+') ? token.substr(1) : token;
        const auto [stop, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (code != std::errc{} || stop != digits.data() + digits.size() || !std::isfinite(value))
            return fail(fmt::format("expected {}, found '{}'", what, printable(token)));
        return true;
    }

    bool number(double& value, std::string_view what, double least, double most) {
        if (!number(value, what)) return false;
        if (value >= least && value <= most) return true;
        return fail(fmt::format("{} is {:g}, expected {:g} to {:g}", what, value, least, most));
    }

    bool count(std::size_t& value, std::string_view what) {
        double read = 0.0;
        if (!number(read, what, 1.0, double(kMostAngles))) return false;
        if (read != std::floor(read))
            return fail(fmt::format("{} is {:g}, expected a whole number", what, read));
        value = std::size_t(read);
        return true;
    }

    bool fail(const std::string& message) {
        if (!failure) failure = error(message);
        return false;
    }

    std::optional<Error> failure; // the first one

  private:
    static std::string_view skipSeparators(std::string_view s) {
        s.remove_prefix(std::min(s.find_first_not_of(" \t\v\f,"), s.size()));
        return s;
    }

    std::string_view rest_, tokens_; // what comes after this line, and what is left of it
    const std::string& path_;
    int line_ = 0;
};

// Label lines up to the one that begins with TILT=, of which the rest is returned in `tilt`.
bool readLabels(Reader& in, IesProfile& profile, std::string& tilt) {
    profile.standard = "LM-63-1986";
    std::string_view raw;
    std::string catalog, firstLabel;
    for (bool first = true; in.nextLine(raw); first = false) {
        const std::string_view line = trimmed(raw);
        if (line.starts_with("TILT=")) {
            tilt = trimmed(line.substr(5));
            if (profile.name.empty()) profile.name = catalog.empty() ? firstLabel : catalog;
            return true;
        }
        if (first && (line.starts_with("IES"))) {
            profile.standard = line;
            continue;
        }
        if (firstLabel.empty() && !line.empty() && line.front() != '[') firstLabel = line;
        if (line.starts_with("[LUMINAIRE]") && profile.name.empty()) profile.name = trimmed(line.substr(11));
        if (line.starts_with("[LUMCAT]") && catalog.empty()) catalog = trimmed(line.substr(8));
    }
    return in.fail("expected a line that begins with TILT=, the file ends");
}

// The factor at tilt 0, as a light is aimed by its node.
bool readTilt(Reader& in, const std::string& tilt, double& factor) {
    factor = 1.0;
    if (tilt == "NONE") return true;
    if (tilt != "INCLUDE") {
        return in.fail(fmt::format("TILT={}: expected NONE or INCLUDE; factors in another file are not read",
                                   printable(tilt)));
    }
    double geometry = 0.0;
    std::size_t count = 0;
    if (!in.number(geometry, "the lamp to luminaire geometry", 1.0, 3.0)) return false;
    if (!in.count(count, "the number of tilt angles")) return false;
    std::vector<double> angles(count), factors(count);
    for (double& angle : angles)
        if (!in.number(angle, "a tilt angle", 0.0, 360.0)) return false;
    for (double& f : factors)
        if (!in.number(f, "a tilt factor", 0.0, 1.0e6)) return false;
    factor = factors[std::size_t(std::min_element(angles.begin(), angles.end()) - angles.begin())];
    return true;
}

struct Header {
    double lamps = 0.0, lumensPerLamp = 0.0, multiplier = 0.0, type = 0.0, units = 0.0;
    double ballast = 0.0, ballastLamp = 0.0;
    std::size_t verticals = 0, horizontals = 0;
};

bool readHeader(Reader& in, IesProfile& profile, Header& h) {
    glm::dvec3& size = profile.widthLengthHeightM;
    const bool read = in.number(h.lamps, "the number of lamps", 0.0, 1.0e6) &&
                      in.number(h.lumensPerLamp, "the lumens per lamp") &&
                      in.number(h.multiplier, "the candela multiplier", 0.0, 1.0e9) &&
                      in.count(h.verticals, "the number of vertical angles") &&
                      in.count(h.horizontals, "the number of horizontal angles") &&
                      in.number(h.type, "the photometric type", 1.0, 3.0) &&
                      in.number(h.units, "the units type", 1.0, 2.0) && in.number(size.x, "the width") &&
                      in.number(size.y, "the length") && in.number(size.z, "the height") &&
                      in.number(h.ballast, "the ballast factor", 0.0, 1.0e6) &&
                      in.number(h.ballastLamp, "the ballast-lamp photometric factor", 0.0, 1.0e6) &&
                      in.number(profile.inputWatts, "the input watts");
    if (!read) return false;
    if (h.type != std::floor(h.type)) return in.fail("expected a photometric type of 1 (C), 2 (B) or 3 (A)");
    if (h.units != std::floor(h.units)) return in.fail("expected units of 1 (feet) or 2 (metres)");
    if (h.verticals * h.horizontals > kMostAngles * 10)
        return in.fail(fmt::format("{} x {} angles are too many", h.verticals, h.horizontals));
    profile.photometry = IesPhotometry(int(h.type));
    if (h.units == 1.0) size *= kMetresPerFoot;
    if (h.lumensPerLamp > 0.0 && h.lamps > 0.0) profile.lampLumens = h.lamps * h.lumensPerLamp;
    // From 2019 on the number says how the file came about and is no factor.
    if (profile.standard.starts_with("IES:LM-63-2019")) h.ballastLamp = 1.0;
    return true;
}

bool readAngles(Reader& in, std::vector<double>& angles, std::size_t count, std::string_view what,
                double least, double most) {
    angles.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (!in.number(angles[i], fmt::format("{} angle {} of {}", what, i + 1, count), least, most))
            return false;
        if (i > 0 && !(angles[i] > angles[i - 1]))
            return in.fail(fmt::format("{} angle {} is {:g}, expected more than the {:g} before it", what,
                                       i + 1, angles[i], angles[i - 1]));
    }
    return true;
}

// Whether the horizontal angles cover a circle by one of the symmetries; a full turn without its last plane
// gets it.
bool completeTurn(Reader& in, IesProfile& p) {
    std::vector<double>& h = p.horizontalDeg;
    if (h.size() == 1) return true;
    const double first = h.front(), last = h.back();
    if (p.photometry != IesPhotometry::C) {
        if ((first == -90.0 || first == 0.0) && last == 90.0) return true;
        return in.fail(
            fmt::format("horizontal angles go from {:g} to {:g}, expected -90 or 0 to 90", first, last));
    }
    if ((first == 90.0 && last == 270.0) ||
        (first == 0.0 && (last == 90.0 || last == 180.0 || last == 360.0)))
        return true;
    if (first == 0.0 && last > 180.0 && last < 360.0 && last + 2.0 * (last - h[h.size() - 2]) >= 360.0) {
        h.push_back(360.0);
        p.candela.insert(p.candela.end(), p.candela.begin(),
                         p.candela.begin() + std::ptrdiff_t(p.verticalDeg.size()));
        return true;
    }
    return in.fail(fmt::format(
        "horizontal angles go from {:g} to {:g}, expected 0 to 90, 180 or 360, or 90 to 270", first, last));
}

bool readTable(Reader& in, IesProfile& profile, const Header& h, double tiltFactor) {
    const bool c = profile.photometry == IesPhotometry::C;
    if (!readAngles(in, profile.verticalDeg, h.verticals, "vertical", c ? 0.0 : -90.0, c ? 180.0 : 90.0))
        return false;
    if (!readAngles(in, profile.horizontalDeg, h.horizontals, "horizontal", c ? 0.0 : -90.0,
                    c ? 360.0 : 90.0))
        return false;
    const double factor = h.multiplier * h.ballast * h.ballastLamp * tiltFactor;
    profile.candela.resize(h.verticals * h.horizontals);
    for (std::size_t i = 0; i < profile.candela.size(); ++i) {
        double value = 0.0;
        if (!in.number(value, fmt::format("intensity {} of {}", i + 1, profile.candela.size()), 0.0, 1.0e12))
            return false;
        profile.candela[i] = value * factor;
    }
    return completeTurn(in, profile);
}

} // namespace

Result<IesProfile> parseIes(std::string_view text, const std::string& path) {
    Reader in(text, path);
    IesProfile profile;
    Header header;
    std::string tilt;
    double tiltFactor = 1.0;
    if (!readLabels(in, profile, tilt) || !readTilt(in, tilt, tiltFactor) ||
        !readHeader(in, profile, header) || !readTable(in, profile, header, tiltFactor))
        return *in.failure;
    if (profile.efficiency().value_or(0.0) > kMostEfficiency) {
        return Error{fmt::format("{}: {:.0f} lm come out of lamps of {:.0f} lm; expected at most as many",
                                 path, profile.fluxLm(), *profile.lampLumens)};
    }
    return profile;
}

Result<IesProfile> readIes(const std::filesystem::path& path) {
    std::error_code code;
    const std::uintmax_t bytes = std::filesystem::file_size(path, code);
    if (code) return Error{fmt::format("{}: cannot be read: {}", path.string(), code.message())};
    if (bytes > kMostBytes)
        return Error{fmt::format("{}: {} bytes, expected at most 16 MiB", path.string(), bytes)};
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file) return Error{fmt::format("{}: cannot be read", path.string())};
    return parseIes(text.str(), path.string());
}

} // namespace kilolux
