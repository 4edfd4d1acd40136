// The merged selection: frequency = reported probability at every limit of the budgets, shares, and the mean.
#include "tests/unit/selection/selection_kit.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace kilolux::test {
namespace {

struct Case {
    const char* name;
    Lights lights;
    f64::SelectionBudget budget;
    double hiddenShare;      // expected, of all samples
    double directionalShare; // expected, of all samples
    double domeShare = 0.0;  // expected, of all samples
};

f64::SelectionBudget failedReprojection() {
    f64::SelectionBudget budget = defaultBudget();
    budget.hiddenShare = 0.5;
    return budget;
}

f64::SelectionBudget arriving(double share) {
    f64::SelectionBudget budget = defaultBudget();
    budget.hiddenArriving = share;
    return budget;
}

std::vector<Case> cases() {
    const f64::SelectionBudget usual = defaultBudget();
    const f64::SelectionBudget closed = {.hiddenShare = 0.0,
                                         .hiddenArriving = 0.0,
                                         .hiddenSeenShare = 0.0,
                                         .hiddenRelaxedBelow = 0.0,
                                         .directionalShare = 0.0,
                                         .directionalFreeBelow = 0.0,
                                         .domeShare = 0.0};
    const f64::SelectionBudget open = {.hiddenShare = 1.0,
                                       .hiddenArriving = 0.0,
                                       .hiddenSeenShare = 0.0,
                                       .hiddenRelaxedBelow = 0.0,
                                       .directionalShare = 1.0,
                                       .directionalFreeBelow = 0.0,
                                       .domeShare = 1.0};
    const double least = 1.0 / 1024.0; // what a share of 0 is raised to
    return {
        {"one visible", {{2.0}, {}, {}}, usual, 0.0, 0.0},
        {"one hidden", {{}, {2.0}, {}}, usual, 1.0, 0.0},
        {"one directional", {{}, {}, {2.0}}, usual, 0.0, 1.0},
        {"three directional", {{}, {}, {2.0, 1.0, 4.0}}, usual, 0.0, 1.0},
        {"all visible", {{1.0, 2.0, 0.5, 3.0, 1.0}, {}, {}}, usual, 0.0, 0.0},
        {"all hidden", {{}, {1.0, 2.0, 0.5, 3.0, 1.0}, {}}, usual, 1.0, 0.0},
        {"hidden capped", {{1.0, 2.0, 1.0}, {5.0, 1.0, 9.0}, {}}, usual, 0.2, 0.0},
        {"hidden at its cap", {{4.0}, {1.0}, {}}, usual, 0.2, 0.0},
        {"hidden under its cap", {{4.0, 4.0}, {0.5, 0.5}, {}}, usual, 1.0 / 9.0, 0.0},
        {"hidden huge", {{1.0, 2.0}, {1e5, 1e3}, {}}, usual, 0.2, 0.0},
        {"hidden tiny", {{1.0, 2.0}, {1e-3, 2e-3}, {}}, usual, 3e-3 / 3.003, 0.0},
        {"reprojection failed", {{1.0, 2.0, 1.0}, {5.0, 1.0, 9.0}, {}}, failedReprojection(), 0.5, 0.0},
        {"reprojection failed, hidden weak", {{4.0}, {1.0, 1.0}, {}}, failedReprojection(), 1.0 / 3.0, 0.0},
        {"few rays to hidden arrive", {{4.0}, {8.0, 8.0}, {}}, arriving(1.0 / 32.0), 0.2, 0.0},
        {"half of those to hidden arrive", {{1.0, 3.0}, {8.0, 4.0}, {}}, arriving(0.5), 0.6, 0.0},
        {"all of those to hidden arrive", {{1.0, 2.0}, {2.0, 1.0}, {}}, arriving(1.0), 0.5, 0.0},
        {"hidden arrive, but take no more", {{1.0, 2.0}, {90.0, 60.0}, {}}, arriving(1.0), 0.8, 0.0},
        {"hidden arrive, visible dim", {{0.01}, {0.2, 0.2}, {}}, arriving(1.0), 40.0 / 41.0, 0.0},
        {"visible at its threshold", {{0.06, 0.04}, {5.0, 1.0}, {}}, usual, 0.2, 0.0},
        {"visible under its threshold", {{0.02, 0.03}, {5.0, 1.0}, {}}, usual, 1.0 / 3.0, 0.0},
        {"visible nearly nothing", {{0.0025}, {5.0, 1.0}, {}}, usual, 10.0 / 11.0, 0.0},
        {"visible dim, hidden dimmer", {{0.05}, {0.01}, {}}, usual, 1.0 / 6.0, 0.0},
        {"sun capped", {{1.0, 2.0}, {}, {90.0}}, usual, 0.0, 0.5},
        {"suns capped", {{1.0, 2.0}, {}, {60.0, 30.0}}, usual, 0.0, 0.5},
        {"sun under its cap", {{1.0, 2.0}, {}, {1.0}}, usual, 0.0, 0.25},
        {"sun free beside dim lights", {{0.05}, {}, {4.95}}, usual, 0.0, 0.99},
        {"sun capped beside hidden lights", {{}, {1.0, 3.0}, {50.0}}, usual, 0.5, 0.5},
        {"sun free beside dim hidden lights", {{}, {0.01, 0.03}, {0.36}}, usual, 0.1, 0.9},
        {"both capped", {{1.0, 3.0}, {20.0, 10.0}, {50.0, 7.0}}, usual, 0.1, 0.5},
        {"zero weights", {{0.0, 1.0, 0.0}, {0.0, 0.0, 3.0}, {0.0, 8.0}}, usual, 0.1, 0.5},
        {"dead visible list", {{0.0, 0.0}, {1.0, 3.0}, {}}, usual, 1.0, 0.0},
        {"shares of 0 lose nobody", {{1.0}, {9.0}, {}}, closed, least, 0.0},
        {"directional share of 0", {{1.0}, {}, {9.0}}, closed, 0.0, least},
        {"no budgets", {{1.0, 2.0}, {3.0, 4.0}, {10.0}}, open, 7.0 / 20.0, 0.5},
        {"dome alone", {{}, {}, {}, 2.0}, usual, 0.0, 0.0, 1.0},
        {"dome capped", {{1.0, 2.0}, {}, {}, 90.0}, usual, 0.0, 0.0, 0.5},
        {"dome under its cap", {{1.0, 2.0}, {}, {}, 1.0}, usual, 0.0, 0.0, 0.25},
        {"dome free beside dim lights", {{0.05}, {}, {}, 4.95}, usual, 0.0, 0.0, 0.99},
        {"dome capped beside hidden lights", {{}, {1.0, 3.0}, {}, 50.0}, usual, 0.5, 0.0, 0.5},
        {"dome and suns", {{}, {}, {2.0, 1.0}, 1.0}, usual, 0.0, 0.75, 0.25},
        {"all capped", {{1.0, 3.0}, {20.0, 10.0}, {50.0, 7.0}, 90.0}, usual, 0.05, 0.25, 0.5},
        {"dome share of 0", {{1.0}, {}, {}, 9.0}, closed, 0.0, 0.0, least},
        {"dome of weight 0", {{1.0}, {}, {}, 0.0}, usual, 0.0, 0.0, 0.0},
        {"even split", {{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}}, open, 1.0 / 3.0, 1.0 / 3.0},
    };
}

double shareOf(uint list, const Case& c) {
    if (list == f64::LIST_HIDDEN) return c.hiddenShare;
    if (list == f64::LIST_DIRECTIONAL) return c.directionalShare;
    if (list == f64::LIST_DOME) return c.domeShare;
    return 1.0 - c.hiddenShare - c.directionalShare - c.domeShare;
}

// What the definition asks for: the list's share times the weight's share of the list.
std::vector<double> expectedProbabilities(const Case& c) {
    std::vector<double> expected;
    uint list = f64::LIST_VISIBLE;
    for (const std::vector<double>* weights : {&c.lights.visible, &c.lights.hidden, &c.lights.directional}) {
        const double sum = std::accumulate(weights->begin(), weights->end(), 0.0);
        for (const double weight : *weights)
            expected.push_back(sum > 0.0 ? shareOf(list, c) * weight / sum : 0.0);
        ++list;
    }
    if (c.lights.dome >= 0.0) expected.push_back(c.domeShare);
    return expected;
}

TEST(Budget, ReportedProbabilitiesAreTheDefinition) {
    for (const Case& c : cases()) {
        const std::vector<double> expected = expectedProbabilities(c);
        const f64::LightSelection all = select(c.lights.candidates(), {0.5, 0.5, 0.5});
        const f64::vec4 sums(all.visibleSum, all.hiddenSum, all.directionalSum, all.domeSum);
        double sum = 0.0;
        for (const auto& [item, choice] : outcomes(c.lights.candidates(), c.budget)) {
            ASSERT_LT(item, expected.size()) << c.name;
            EXPECT_NEAR(choice.probability, expected[item], 1e-9 * expected[item]) << c.name << ", " << item;
            EXPECT_EQ(choice.contribution, 1.0 / choice.probability) << c.name;
            const f64::Candidate candidate = c.lights.candidates()[item];
            EXPECT_EQ(choice.list, candidate.list) << c.name;
            EXPECT_NEAR(f64::candidateProbability(sums, c.budget, candidate.list, candidate.weight),
                        choice.probability, 1e-12)
                << c.name << ", as the probe tells it";
            sum += choice.probability;
        }
        EXPECT_NEAR(sum, 1.0, c.lights.hidden.empty() || c.lights.hidden[0] < 1e4 ? 1e-9 : 1e-3) << c.name;
    }
}

// All three numbers on a grid, so that a number used twice shows as well as a wrong share.
TEST(Budget, FrequencyIsTheReportedProbability) {
    const uint gridVisible = 256;
    const uint gridHidden = 128;
    for (const Case& c : cases()) {
        const std::vector<f64::Candidate> candidates = c.lights.candidates();
        const uint gridDirectional = c.lights.directional.size() > 1 ? 32 : 1;
        std::vector<double> frequency(candidates.size());
        const double step = 1.0 / (gridVisible * gridHidden * gridDirectional);
        for (uint v = 0; v < gridVisible; ++v)
            for (uint h = 0; h < gridHidden; ++h)
                for (uint d = 0; d < gridDirectional; ++d) {
                    const f64::vec3 numbers((v + 0.5) / gridVisible, (h + 0.5) / gridHidden,
                                            (d + 0.5) / gridDirectional);
                    const f64::LightChoice choice =
                        f64::selectionSample(select(candidates, numbers), c.budget, 0);
                    ASSERT_LT(choice.item, candidates.size()) << c.name;
                    frequency[choice.item] += step;
                }
        const std::vector<double> expected = expectedProbabilities(c);
        for (uint item = 0; item < candidates.size(); ++item) {
            const uint list = candidates[item].list;
            const double within = list == f64::LIST_DIRECTIONAL ? 3.0 / gridDirectional : 3.0 / gridHidden;
            const double resolution =
                4.0 / gridVisible +
                (list == f64::LIST_VISIBLE || list == f64::LIST_DOME ? 0.0 : within * shareOf(list, c));
            EXPECT_NEAR(frequency[item], expected[item], resolution) << c.name << ", item " << item;
            if (expected[item] == 0.0) {
                EXPECT_EQ(frequency[item], 0.0) << c.name << ", item " << item;
            }
        }
    }
}

// Each number by itself, finely: bisection finds the ends of every range.
TEST(Budget, FrequencyOfEachNumberFinely) {
    for (const Case& c : cases()) {
        const std::vector<f64::Candidate> candidates = c.lights.candidates();
        const std::vector<double> expected = expectedProbabilities(c);
        std::vector<double> numberOfList(4, -1.0);
        std::map<uint, double> byVisible = measureByKey(
            [&](double u) {
                const f64::LightChoice choice =
                    f64::selectionSample(select(candidates, {u, 0.3, 0.7}), c.budget, 0);
                numberOfList[choice.list] = u;
                return choice.list == f64::LIST_VISIBLE ? choice.item : 1000 + choice.list;
            },
            8192);
        for (uint item = 0; item < c.lights.visible.size(); ++item)
            EXPECT_NEAR(byVisible[item], expected[item], 1e-7) << c.name << ", item " << item;
        for (const uint list : {f64::LIST_HIDDEN, f64::LIST_DIRECTIONAL, f64::LIST_DOME}) {
            EXPECT_NEAR(byVisible[1000 + list], shareOf(list, c), 1e-7) << c.name << ", list " << list;
            if (numberOfList[list] < 0.0) continue;
            std::map<uint, double> byOwn = measureByKey(
                [&](double u) {
                    return f64::selectionSample(select(candidates, {numberOfList[list], u, u}), c.budget, 0)
                        .item;
                },
                8192);
            for (uint item = 0; item < candidates.size(); ++item)
                if (candidates[item].list == list) {
                    EXPECT_NEAR(byOwn[item] * shareOf(list, c), expected[item], 1e-7)
                        << c.name << ", " << item;
                }
        }
    }
}

TEST(Budget, NothingToChooseFrom) {
    for (const Lights& lights :
         {Lights{}, Lights{{0.0, 0.0}, {0.0}, {0.0}}, Lights{{std::nan("")}, {}, {-1.0}}}) {
        const f64::LightChoice choice =
            f64::selectionSample(select(lights.candidates(), {0.3, 0.4, 0.5}), defaultBudget(), 0);
        EXPECT_EQ(choice.item, f64::KX_NO_ITEM);
        EXPECT_EQ(choice.probability, 0.0);
        EXPECT_EQ(choice.contribution, 0.0);
    }
}

// A light's share never jumps where the visible sum crosses its threshold.
TEST(Budget, HiddenShareRisesWithoutAStep) {
    double last = 1.0;
    for (double visible = 1e-6; visible < 1.0; visible *= 1.01) {
        const double hidden = f64::budgetedSums(visible, 50.0, 0.0, defaultBudget()).x;
        const double share = hidden / (visible + hidden);
        EXPECT_LE(share, last + 1e-12);
        EXPECT_LT(last - share, 0.01) << visible;
        EXPECT_GE(share, 0.2 - 1e-12);
        if (visible >= 0.1) {
            EXPECT_NEAR(share, 0.2, 1e-12);
        }
        last = share;
    }
}

// What is left of the visible list's number after the merge is uniform for each light: bounded discrepancy.
TEST(Budget, RestOfTheNumberIsUniformAfterTheMerge) {
    const Case c = {"", {{1.0, 3.0, 2.0}, {20.0, 10.0}, {50.0}}, defaultBudget(), 0.0, 0.0};
    std::map<uint, std::vector<double>> rests;
    const uint inputs = 65536;
    for (uint i = 0; i < inputs; ++i) {
        const f64::LightChoice choice =
            f64::selectionSample(select(c.lights.candidates(), {(i + 0.5) / inputs, 0.3, 0.3}), c.budget, 0);
        rests[choice.list == f64::LIST_VISIBLE ? choice.item : 100 + choice.list].push_back(choice.number);
    }
    EXPECT_EQ(rests.size(), 5u);
    for (auto& [key, rest] : rests) {
        std::sort(rest.begin(), rest.end());
        for (uint i = 0; i < rest.size(); ++i)
            ASSERT_LT(std::abs(i + 0.5 - rest[i] * double(rest.size())), 4.0) << key;
    }
}

// Every one of K samples has the reported probability; together they are spread over the lights.
TEST(Budget, SeveralSamplesEachHaveTheProbability) {
    const Lights lights = {{1.0, 1.0, 2.0}, {2.0, 4.0}, {9.0}};
    const f64::SelectionBudget budget = defaultBudget();
    for (const uint count : {2u, 4u, 7u, 16u}) {
        std::vector<double> frequency(lights.count());
        std::map<uint, double> probability;
        const uint grid = 128;
        for (uint v = 0; v < grid; ++v)
            for (uint h = 0; h < grid; ++h) {
                const f64::LightSelection s =
                    select(lights.candidates(), {(v + 0.5) / grid, (h + 0.5) / grid, 0.5}, count);
                for (uint k = 0; k < count; ++k) {
                    const f64::LightChoice choice = f64::selectionSample(s, budget, k);
                    frequency[choice.item] += 1.0 / (grid * grid * count);
                    probability[choice.item] = choice.probability;
                }
            }
        for (uint item = 0; item < lights.count(); ++item)
            EXPECT_NEAR(frequency[item], probability[item], 0.02 / count + 0.004)
                << count << " samples, " << item;
    }
    const Lights two = {{1.0, 1.0}, {}, {}};
    for (uint v = 0; v < 64; ++v) {
        const f64::LightSelection s = select(two.candidates(), {(v + 0.5) / 64, 0.5, 0.5}, 16);
        int first = 0;
        for (uint k = 0; k < 16; ++k)
            first += f64::selectionSample(s, budget, k).item == 0 ? 1 : 0;
        EXPECT_EQ(first, 8) << "16 samples of two equal lights";
    }
}

} // namespace
} // namespace kilolux::test
