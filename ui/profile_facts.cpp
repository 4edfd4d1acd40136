#include "ui/profile_facts.h"

#include "renderer/document/file_replace.h"
#include "ui/scene_folder.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kilolux {

namespace {

namespace fs = std::filesystem;

constexpr double kStepDeg = 0.25;

glm::dvec3 directionOf(double planeDeg, double degrees) {
    const double plane = glm::radians(planeDeg), angle = glm::radians(degrees);
    return {std::sin(angle) * std::cos(plane), std::sin(angle) * std::sin(plane), -std::cos(angle)};
}

std::string symmetryOf(const IesProfile& profile) {
    const double first = profile.horizontalDeg.front(), last = profile.horizontalDeg.back();
    if (profile.photometry != IesPhotometry::C) return first < 0.0 ? "none" : "two halves";
    if (profile.horizontalDeg.size() == 1) return "round";
    if (last == 90.0) return "quadrants";
    return last == 180.0 || first == 90.0 ? "two halves" : "none";
}

// Of the part about the strongest direction in which the intensity is at least a share of the largest.
double widthDeg(const std::vector<double>& candela, double share) {
    const auto peak = std::max_element(candela.begin(), candela.end());
    if (peak == candela.end() || !(*peak > 0.0)) return 0.0;
    const auto weak = [&](double value) { return value < share * *peak; };
    const auto right = std::find_if(peak, candela.end(), weak);
    const auto left = std::find_if(std::make_reverse_iterator(peak), candela.rend(), weak);
    return kStepDeg * double(right - left.base());
}

} // namespace

double relativeAt(const IesProfile& profile, double planeDeg, double degrees) {
    const double most = profile.maxCandela();
    return most > 0.0 ? profile.candelaAt(directionOf(planeDeg, degrees)) / most : 0.0;
}

ProfileFacts factsOf(const IesProfile& profile) {
    ProfileFacts facts;
    facts.lumens = profile.fluxLm();
    facts.maxCandela = profile.maxCandela();
    facts.symmetry = symmetryOf(profile);
    for (int plane = 0; plane < 2; ++plane) {
        std::vector<double> candela;
        for (double at = -180.0; at <= 180.0; at += kStepDeg)
            candela.push_back(profile.candelaAt(directionOf(90.0 * plane, at)));
        facts.beamDeg[plane] = widthDeg(candela, 0.5);
        facts.fieldDeg[plane] = widthDeg(candela, 0.1);
    }
    return facts;
}

std::vector<std::vector<glm::dvec3>> webOf(const IesProfile& profile) {
    std::vector<std::vector<glm::dvec3>> lines;
    const double most = profile.maxCandela();
    if (!(most > 0.0)) return lines;
    const auto point = [&](double planeDeg, double degrees) {
        const glm::dvec3 direction = directionOf(planeDeg, degrees);
        return direction * (profile.candelaAt(direction) / most);
    };
    for (const double plane : {0.0, 45.0, 90.0, 135.0}) {
        lines.emplace_back();
        for (int step = 0; step <= 90; ++step)
            lines.back().push_back(point(plane, 4.0 * step));
    }
    for (const double off : {30.0, 60.0, 90.0, 120.0, 150.0}) {
        lines.emplace_back();
        for (int step = 0; step <= 48; ++step)
            lines.back().push_back(point(7.5 * step, off));
    }
    return lines;
}

std::vector<ProfileEntry> profilesIn(const fs::path& folder) {
    std::vector<ProfileEntry> entries;
    for (const fs::path& path : pathsBelow(folder, kProfileEndings)) {
        ProfileEntry entry;
        entry.path = path;
        entry.name = path.lexically_relative(folder).generic_string();
        Result<IesProfile> profile = readIes(path);
        if (profile) {
            entry.title = profile.value().name;
            entry.facts = factsOf(profile.value());
            entry.profile = std::make_shared<const IesProfile>(std::move(profile.value()));
        } else {
            entry.error = profile.error();
        }
        entries.push_back(std::move(entry));
    }
    return entries;
}

Result<std::string> bringProfile(const fs::path& profile, const fs::path& sceneFolder) {
    const fs::path folder = fs::absolute(sceneFolder.empty() ? "." : sceneFolder).lexically_normal();
    const fs::path from = fs::absolute(profile).lexically_normal();
    const fs::path inside = from.lexically_relative(folder);
    if (!inside.empty() && *inside.begin() != "..") return uriOf(inside);
    const Result<std::string> bytes = readWholeFile(from);
    if (!bytes) return Error{bytes.error()};
    for (int number = 1; number < 1000; ++number) {
        const std::string name =
            number == 1 ? from.filename().string() : fmt::format("{}_{}.ies", from.stem().string(), number);
        const fs::path to = folder / "profiles" / name;
        std::error_code error;
        if (fs::exists(to, error)) {
            const Result<std::string> there = readWholeFile(to);
            if (there && there.value() == bytes.value()) return uriOf(fs::path("profiles") / name);
            continue;
        }
        fs::create_directories(to.parent_path(), error);
        if (!fs::copy_file(from, to, error))
            return Error{fmt::format("{}: cannot be written: {}", to.string(), error.message())};
        return uriOf(fs::path("profiles") / name);
    }
    return Error{fmt::format("{}: expected a free name for the profile", (folder / "profiles").string())};
}

} // namespace kilolux
