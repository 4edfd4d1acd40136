#include "tests/unit/selection/selection_kit.h"

namespace kilolux::test {

std::vector<f64::Candidate> Lights::candidates() const {
    std::vector<f64::Candidate> all;
    for (const double weight : visible)
        all.push_back({static_cast<uint>(all.size()), f64::LIST_VISIBLE, weight, 1.0});
    for (const double weight : hidden)
        all.push_back({static_cast<uint>(all.size()), f64::LIST_HIDDEN, weight, 1.0});
    for (const double weight : directional)
        all.push_back({static_cast<uint>(all.size()), f64::LIST_DIRECTIONAL, weight, 1.0});
    if (dome >= 0.0) all.push_back({static_cast<uint>(all.size()), f64::LIST_DOME, dome, 1.0});
    return all;
}

f64::SelectionBudget defaultBudget() {
    return {.hiddenShare = 0.2,
            .hiddenArriving = 0.0,
            .hiddenSeenShare = 0.8,
            .hiddenRelaxedBelow = 0.1,
            .directionalShare = 0.5,
            .directionalFreeBelow = 0.1,
            .domeShare = 0.5};
}

f64::LightSelection select(const std::vector<f64::Candidate>& candidates, const f64::vec3& numbers,
                           uint sampleCount) {
    f64::LightSelection selection = f64::beginSelection(numbers, sampleCount);
    for (const f64::Candidate& candidate : candidates)
        f64::selectionAdd(selection, candidate);
    return selection;
}

std::map<uint, double> measureByKey(const std::function<uint(double)>& key, uint gridSize) {
    std::map<uint, double> measure;
    double start = 0.0;
    double at = 0.5 / gridSize;
    uint current = key(at);
    for (uint i = 1; i < gridSize; ++i) {
        const double next = (i + 0.5) / gridSize;
        const uint nextKey = key(next);
        if (nextKey != current) {
            double low = at;
            double high = next;
            for (int step = 0; step < 36; ++step) {
                const double middle = 0.5 * (low + high);
                (key(middle) == current ? low : high) = middle;
            }
            measure[current] += high - start;
            start = high;
            current = nextKey;
        }
        at = next;
    }
    measure[current] += 1.0 - start;
    return measure;
}

std::map<uint, f64::LightChoice> outcomes(const std::vector<f64::Candidate>& candidates,
                                          const f64::SelectionBudget& budget) {
    std::map<uint, f64::LightChoice> found;
    const uint steps = 4096;
    std::map<uint, double> numberByList; // of the visible list, that leads to each list
    for (uint i = 0; i < steps; ++i) {
        const double number = (i + 0.5) / steps;
        const f64::LightChoice c = f64::selectionSample(select(candidates, {number, 0.5, 0.5}), budget, 0);
        numberByList[c.list] = number;
        if (c.item != f64::KX_NO_ITEM) found[c.item] = c;
    }
    for (const auto& [list, visibleNumber] : numberByList)
        for (uint i = 0; i < steps && list != f64::LIST_VISIBLE; ++i) {
            const double number = (i + 0.5) / steps;
            const f64::LightChoice c =
                f64::selectionSample(select(candidates, {visibleNumber, number, number}), budget, 0);
            found[c.item] = c;
        }
    return found;
}

} // namespace kilolux::test
