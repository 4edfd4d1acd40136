#include "ui/light_list_model.h"

#include "renderer/document/edit.h"
#include "renderer/document/light_units.h"
#include "renderer/document/light_words.h"
#include "ui/text_case.h"

#include <algorithm>

namespace kilolux {

namespace {

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

std::vector<std::string> wordsOf(std::string_view text) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : lowered(text) + ' ') {
        if (c != ' ' && c != '\t') {
            word += c;
        } else if (!word.empty()) {
            words.push_back(std::move(word));
            word.clear();
        }
    }
    return words;
}

bool hasAll(std::string_view loweredText, std::span<const std::string> words) {
    return std::all_of(words.begin(), words.end(), [&](const std::string& word) {
        return loweredText.find(word) != std::string_view::npos;
    });
}

std::vector<std::uint64_t> sortedUnique(std::vector<std::uint64_t> ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

int rowOfAnchor(std::span<const LightRow> rows, const RowAnchor& anchor) {
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (anchor.id != 0 && rows[i].kind == anchor.kind && rows[i].id == anchor.id) return int(i);
    return -1;
}

void appendRow(const Scene& scene, const LightRow& row, std::vector<std::uint64_t>& ids) {
    if (row.kind == LightRow::Kind::Light) {
        ids.push_back(row.id);
        return;
    }
    for (const LightNode& light : scene.lights)
        if (light.group == row.id) ids.push_back(light.id);
}

} // namespace

bool containsWords(std::string_view text, std::string_view search) {
    return hasAll(lowered(text), wordsOf(search));
}

std::string naturalKey(std::string_view text) {
    std::string key;
    for (std::size_t i = 0; i < text.size();) {
        if (!isDigit(text[i])) {
            key += lowered(text.substr(i, 1));
            ++i;
            continue;
        }
        while (i < text.size() && text[i] == '0')
            ++i;
        std::size_t end = i;
        while (end < text.size() && isDigit(text[end]))
            ++end;
        // More digits are a larger number; before letters, as digits are.
        key += '0';
        key += char('0' + std::min<std::size_t>(end - i, 9));
        key += text.substr(i, end - i);
        i = end;
    }
    return key;
}

bool LightListModel::update(const Scene& scene, std::uint64_t version, const LightListQuery& query) {
    const bool sameScene = built_ && version == version_;
    LightListQuery wanted = query;
    // Where distances sort nothing, moving the camera changes nothing.
    if (query.order != LightOrder::Distance) wanted.eyeWs = glm::dvec3(0.0);
    if (sameScene && wanted == query_) return false;
    if (!sameScene) readEntries(scene);
    query_ = std::move(wanted);
    version_ = version;
    built_ = true;
    buildRows(scene);
    return true;
}

void LightListModel::readEntries(const Scene& scene) {
    entries_.clear();
    entries_.reserve(scene.lights.size());
    for (const LightNode& light : scene.lights) {
        const Node& node = scene.nodes[std::size_t(light.node)];
        const LightDef& def = scene.lightDefs[std::size_t(light.def)];
        Entry entry;
        entry.text = lowered(node.name) + ' ' + wordOf(def.type);
        if (const int group = findGroup(scene, light.group); group >= 0)
            entry.text += ' ' + lowered(scene.groups[std::size_t(group)].name);
        entry.nameKey = naturalKey(node.name);
        entry.intensity = baseIntensity(def);
        entry.positionWs = glm::dvec3(node.worldFromNode[3]);
        entry.id = light.id;
        entry.group = light.group;
        entry.type = def.type;
        entries_.push_back(std::move(entry));
    }
}

std::vector<int> LightListModel::filteredAndSorted() const {
    const std::vector<std::string> words = wordsOf(query_.search);
    std::vector<int> order;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const Entry& entry = entries_[i];
        if (query_.types != 0 && !(query_.types & (1u << unsigned(entry.type)))) continue;
        if (hasAll(entry.text, words)) order.push_back(int(i));
    }
    const auto sortBy = [&](auto key) {
        // Equal ones keep the order of the file either way.
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
            return query_.descending ? key(entries_[std::size_t(b)]) < key(entries_[std::size_t(a)])
                                     : key(entries_[std::size_t(a)]) < key(entries_[std::size_t(b)]);
        });
    };
    const glm::dvec3 eye = query_.eyeWs;
    switch (query_.order) {
    case LightOrder::File:
        if (query_.descending) std::reverse(order.begin(), order.end());
        break;
    case LightOrder::Name:
        sortBy([](const Entry& entry) -> const std::string& { return entry.nameKey; });
        break;
    case LightOrder::Type:
        sortBy([](const Entry& entry) { return int(entry.type); });
        break;
    case LightOrder::Intensity:
        sortBy([](const Entry& entry) { return entry.intensity; });
        break;
    case LightOrder::Distance:
        sortBy([eye](const Entry& entry) {
            // A directional light has no place.
            return entry.type == LightType::Directional
                       ? 1e300
                       : glm::dot(entry.positionWs - eye, entry.positionWs - eye);
        });
        break;
    }
    return order;
}

void LightListModel::buildRows(const Scene& scene) {
    const std::vector<int> order = filteredAndSorted();
    rows_.clear();
    shown_ = int(order.size());
    const auto addLights = [&](std::uint64_t group, bool inGroup) {
        for (const int i : order) {
            const Entry& entry = entries_[std::size_t(i)];
            if (query_.grouped && entry.group != group) continue;
            rows_.push_back({LightRow::Kind::Light, entry.id, i, 0, inGroup});
        }
    };
    if (query_.grouped) {
        const bool narrowed = query_.types != 0 || !wordsOf(query_.search).empty();
        for (std::size_t g = 0; g < scene.groups.size(); ++g) {
            const std::uint64_t id = scene.groups[g].id;
            const auto members = std::count_if(order.begin(), order.end(),
                                               [&](int i) { return entries_[std::size_t(i)].group == id; });
            // A search shows what it finds: no groups that hold nothing of it.
            if (narrowed && members == 0) continue;
            rows_.push_back({LightRow::Kind::Group, id, int(g), int(members), false});
            const bool folded = std::find(query_.foldedGroups.begin(), query_.foldedGroups.end(), id) !=
                                query_.foldedGroups.end();
            if (!folded) addLights(id, true);
        }
    }
    addLights(0, false);
}

int LightListModel::rowOf(std::uint64_t light) const {
    for (std::size_t i = 0; i < rows_.size(); ++i)
        if (rows_[i].kind == LightRow::Kind::Light && rows_[i].id == light) return int(i);
    return -1;
}

std::vector<std::uint64_t> selectionAfter(const Scene& scene, std::span<const LightRow> rows,
                                          std::span<const std::uint64_t> selection, ListClick click,
                                          RowAnchor& anchor) {
    std::vector<std::uint64_t> result(selection.begin(), selection.end());
    if (click.row < 0 || click.row >= int(rows.size())) return result;
    std::vector<std::uint64_t> clicked;
    const int from = click.shift ? rowOfAnchor(rows, anchor) : -1;
    if (from >= 0) {
        for (int i = std::min(from, click.row); i <= std::max(from, click.row); ++i)
            appendRow(scene, rows[std::size_t(i)], clicked);
    } else {
        appendRow(scene, rows[std::size_t(click.row)], clicked);
        anchor = {rows[std::size_t(click.row)].kind, rows[std::size_t(click.row)].id};
    }
    clicked = sortedUnique(std::move(clicked));
    if (!click.ctrl) return clicked;
    const bool allThere = std::includes(result.begin(), result.end(), clicked.begin(), clicked.end());
    if (allThere && from < 0) {
        std::erase_if(
            result, [&](std::uint64_t id) { return std::binary_search(clicked.begin(), clicked.end(), id); });
        return result;
    }
    result.insert(result.end(), clicked.begin(), clicked.end());
    return sortedUnique(std::move(result));
}

} // namespace kilolux
