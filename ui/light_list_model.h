// Which lights the list shows and in which order: search, filter by type, groups, sorting; and what a click
// with Shift or Ctrl selects. Rebuilt only when the document or the question changes, so that 10,000 rows
// stay smooth.
#pragma once

#include "renderer/document/scene.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kilolux {

enum class LightOrder : std::uint8_t { File, Name, Type, Intensity, Distance };

struct LightListQuery {
    std::string search;      // words that must all be part of name, type or group, whatever their case
    std::uint32_t types = 0; // bits 1 << LightType that are shown; 0: all
    LightOrder order = LightOrder::File;
    bool descending = false;
    bool grouped = true; // members stand below their group's row; else all lights in one list
    std::vector<std::uint64_t> foldedGroups;
    glm::dvec3 eyeWs{0.0}; // for the distance
    bool operator==(const LightListQuery&) const = default;
};

struct LightRow {
    enum class Kind : std::uint8_t { Light, Group } kind = Kind::Light;
    std::uint64_t id = 0; // LightNode::id or LightGroup::id
    int index = 0;        // into Scene::lights or Scene::groups, of the scene of the last update()
    int members = 0;      // of a group: lights that pass the filter
    bool inGroup = false; // stands below its group
};

class LightListModel {
  public:
    // True when the rows were made anew. `version` names the state of the document.
    bool update(const Scene& scene, std::uint64_t version, const LightListQuery& query);
    std::span<const LightRow> rows() const { return rows_; }
    int shownLights() const { return shown_; }
    // Row of a light; -1 if it is not shown.
    int rowOf(std::uint64_t light) const;

  private:
    struct Entry {
        std::string text;       // name, type and group in lower case, for the search
        std::string nameKey;    // sorts 'Lamp 2' before 'Lamp 10'
        double intensity = 0.0; // candela; lux of a directional light
        glm::dvec3 positionWs{0.0};
        std::uint64_t id = 0, group = 0;
        LightType type = LightType::Sphere;
    };
    void readEntries(const Scene& scene);
    void buildRows(const Scene& scene);
    std::vector<int> filteredAndSorted() const;

    LightListQuery query_;
    std::uint64_t version_ = 0;
    bool built_ = false;
    std::vector<Entry> entries_; // one per light, as in Scene::lights
    std::vector<LightRow> rows_;
    int shown_ = 0;
};

// Whether all words of a search are part of a text, whatever their case.
bool containsWords(std::string_view text, std::string_view search);

// Sorts numbers in text by their value, letters whatever their case.
std::string naturalKey(std::string_view text);

// The row clicked last without Shift; lights and groups may have the same ids.
struct RowAnchor {
    LightRow::Kind kind = LightRow::Kind::Light;
    std::uint64_t id = 0; // 0: none
};

// The selection after a click on a row; the caller keeps the anchor. Ctrl turns one over, Shift takes the
// rows from the anchor on, both together add them. A group's row stands for its members. Sorted by id.
struct ListClick {
    int row = 0;
    bool shift = false;
    bool ctrl = false;
};
std::vector<std::uint64_t> selectionAfter(const Scene& scene, std::span<const LightRow> rows,
                                          std::span<const std::uint64_t> selection, ListClick click,
                                          RowAnchor& anchor);

} // namespace kilolux
