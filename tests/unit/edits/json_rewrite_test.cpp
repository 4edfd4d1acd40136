// Changing values in JSON text: what it parses as, and what stays byte for byte.
#include "renderer/document/json_rewrite.h"

#include <gtest/gtest.h>
#include <random>

namespace kilolux {
namespace {

using Json = nlohmann::json;

Json randomJson(std::mt19937& random, int depth) {
    const int kind = static_cast<int>(random() % (depth > 0 ? 8 : 6));
    switch (kind) {
    case 0:
        return nullptr;
    case 1:
        return random() % 2 == 0;
    case 2:
        return static_cast<int>(random() % 7) - 3;
    case 3:
        return static_cast<double>(random() % 9) / 7.0;
    case 4:
        return std::string("a\"}],\\ \xC3\xA9\n").substr(random() % 5);
    case 5:
        return Json::object();
    case 6: {
        Json array = Json::array();
        for (unsigned i = random() % 5; i > 0; --i)
            array.push_back(randomJson(random, depth - 1));
        return array;
    }
    default: {
        Json object = Json::object();
        for (unsigned i = random() % 5; i > 0; --i)
            object[std::string(1, static_cast<char>('a' + random() % 5)) + (random() % 3 ? "" : "\"]")] =
                randomJson(random, depth - 1);
        return object;
    }
    }
}

// Changes some values somewhere below.
void mutate(Json& json, std::mt19937& random) {
    if (json.is_structured() && !json.empty() && random() % 4 != 0) {
        auto it = json.begin();
        std::advance(it, random() % json.size());
        if (random() % 6 == 0) {
            json.erase(it);
        } else {
            mutate(*it, random);
        }
    } else if (json.is_array() && random() % 2 == 0) {
        json.insert(json.begin() + static_cast<std::ptrdiff_t>(random() % (json.size() + 1)),
                    randomJson(random, 1));
    } else if (json.is_object() && random() % 2 == 0) {
        json["new" + std::to_string(random() % 3)] = randomJson(random, 2);
    } else {
        json = randomJson(random, 2);
    }
}

TEST(JsonRewrite, ParsesAsWantedAndKeepsTheRest) {
    std::mt19937 random(1);
    for (int i = 0; i < 20000; ++i) {
        const Json before = randomJson(random, 4);
        const int indent = static_cast<int>(random() % 4) - 1;
        const std::string source =
            (random() % 2 ? " \n" : "") + before.dump(indent, random() % 2 ? ' ' : '\t') + "\n ";
        Json after = before;
        for (unsigned n = random() % 4; n > 0; --n)
            mutate(after, random);
        const std::string text = rewriteJson(source, before, after);
        ASSERT_EQ(Json::parse(text), after) << source << "\nbecame\n" << text;
        ASSERT_EQ(rewriteJson(text, after, after), text);
        if (before == after) {
            ASSERT_EQ(text, source);
        }
    }
}

TEST(JsonRewrite, OrderWhitespaceAndDigitsStay) {
    const std::string source = "\xEF\xBB\xBF{\n  \"z\" : 1.50e0,\n  \"a\" : [ 1, 2.0,3 ],\n"
                               "  \"m\" : {\n    \"k\" : \"\\u00e9\"\n  }\n}\n";
    const Json before = Json::parse(source);
    Json after = before;
    after["a"][1] = 7;
    after["m"]["new"] = {{"x", {0.5, 1.5}}};
    EXPECT_EQ(
        rewriteJson(source, before, after),
        "\xEF\xBB\xBF{\n  \"z\" : 1.50e0,\n  \"a\" : [ 1, 7,3 ],\n"
        "  \"m\" : {\n    \"k\" : \"\\u00e9\",\n    \"new\" : {\n      \"x\" : [0.5, 1.5]\n    }\n  }\n}\n");
}

TEST(JsonRewrite, RemovedElementsLeaveTheirNeighbours) {
    const std::string source = R"({"l":[{"n":1.0},{"n":2.0},{"n":3.0}],"l2":{}})";
    const Json before = Json::parse(source);
    Json after = before;
    after["l"].erase(1);
    after["l2"]["x"] = 1;
    EXPECT_EQ(rewriteJson(source, before, after), R"({"l":[{"n":1.0},{"n":3.0}],"l2":{"x":1}})");
}

TEST(JsonRewrite, OfTwinsTheLastCounts) {
    const std::string source = R"({"a":1,"b":2,"a":3})";
    const Json before = Json::parse(source);
    Json after = before;
    after["a"] = 4;
    EXPECT_EQ(Json::parse(rewriteJson(source, before, after)), after);
    EXPECT_EQ(rewriteJson(source, before, before), source);
}

} // namespace
} // namespace kilolux
