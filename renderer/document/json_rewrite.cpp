#include "renderer/document/json_rewrite.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <vector>

namespace kilolux {

namespace {

using Json = nlohmann::json;

bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

// A member of an object or an element of an array, as spans of the text between two separators.
struct Item {
    std::string_view before; // whitespace
    std::string_view key;    // with its quotes and the colon; empty in an array
    std::string_view value;
    std::string_view after; // whitespace
    std::string name;       // the key's meaning
};

// Walks over valid JSON.
class Cursor {
  public:
    explicit Cursor(std::string_view text) : text_(text) {}

    bool atEnd() const { return at_ >= text_.size(); }
    char peek() const { return atEnd() ? '\0' : text_[at_]; }
    void skip() { ++at_; }
    std::string_view space() {
        const std::size_t start = at_;
        while (!atEnd() && isSpace(text_[at_]))
            ++at_;
        return text_.substr(start, at_ - start);
    }
    std::string_view string() {
        const std::size_t start = at_++;
        while (!atEnd() && text_[at_] != '"')
            at_ += text_[at_] == '\\' ? 2 : 1;
        at_ = std::min(at_ + 1, text_.size());
        return text_.substr(start, at_ - start);
    }
    std::string_view value() {
        if (peek() == '"') return string();
        const std::size_t start = at_;
        int depth = 0;
        while (!atEnd()) {
            const char c = text_[at_];
            if (c == '"') {
                string();
                continue;
            }
            if (depth == 0 && (isSpace(c) || c == ',' || c == '}' || c == ']')) break;
            ++at_;
            if (c == '{' || c == '[') ++depth;
            if ((c == '}' || c == ']') && --depth == 0) break;
        }
        return text_.substr(start, at_ - start);
    }
    std::size_t position() const { return at_; }

  private:
    std::string_view text_;
    std::size_t at_ = 0;
};

// One level of a container's text.
std::vector<Item> itemsOf(std::string_view container) {
    std::vector<Item> items;
    const bool isObject = container.front() == '{';
    const std::string_view inner = container.substr(1, container.size() - 2);
    Cursor cursor(inner);
    while (true) {
        Item item;
        item.before = cursor.space();
        if (cursor.atEnd()) break;
        if (isObject) {
            const std::size_t start = cursor.position();
            item.name = Json::parse(cursor.string()).get<std::string>();
            cursor.space();
            cursor.skip(); // the colon
            cursor.space();
            item.key = inner.substr(start, cursor.position() - start);
        }
        item.value = cursor.value();
        item.after = cursor.space();
        items.push_back(std::move(item));
        if (cursor.peek() != ',') break;
        cursor.skip();
    }
    return items;
}

// How new values are laid out inside a container.
struct Layout {
    std::string
        lineStart;    // line break and indentation of the container's own closing bracket; empty: one line
    std::string step; // one level of indentation
    std::string colon = ":";

    Layout deeper() const { return {lineStart.empty() ? "" : lineStart + step, step, colon}; }
    bool hasLines() const { return !lineStart.empty(); }
};

class Rewriter {
  public:
    explicit Rewriter(std::string& out) : out_(out) {}

    void value(std::string_view source, const Json& before, const Json& after, const Layout& layout) {
        if (before == after) {
            out_ += source;
        } else if (before.is_object() && after.is_object() && !before.empty() && !after.empty()) {
            object(source, before, after, layout);
        } else if (before.is_array() && after.is_array() && !before.empty() && !after.empty()) {
            array(source, before, after, layout);
        } else {
            fresh(after, layout);
        }
    }

  private:
    struct Piece {
        const Item* item = nullptr; // the old place, or none for what is new
        std::string name;
        const Json* before = nullptr;
        const Json* after = nullptr;
    };

    // The layout inside a container, seen from its text.
    static Layout layoutOf(const std::vector<Item>& items, const Layout& outer) {
        Layout layout = outer;
        const std::string_view before = items.front().before, closing = items.back().after;
        const auto lineOf = [](std::string_view space) {
            const std::size_t line = space.rfind('\n');
            return line == space.npos ? std::string_view() : space.substr(line);
        };
        layout.lineStart = lineOf(closing);
        if (layout.hasLines() && lineOf(before).size() > layout.lineStart.size())
            layout.step = lineOf(before).substr(layout.lineStart.size());
        if (!items.front().key.empty()) {
            const std::string_view key = items.front().key;
            layout.colon = key.substr(key.rfind('"') + 1);
        }
        return layout;
    }

    void pieces(char open, char close, const std::vector<Item>& items, const std::vector<Piece>& wanted,
                const Layout& outer) {
        const Layout layout = layoutOf(items, outer);
        const bool oneLine = !layout.hasLines();
        out_ += open;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const Piece& piece = wanted[i];
            if (i > 0) out_ += ',';
            if (piece.item) {
                out_ += piece.item->before;
                out_ += piece.item->key;
                value(piece.item->value, *piece.before, *piece.after, layout.deeper());
                if (i + 1 < wanted.size()) out_ += piece.item == &items.back() ? "" : piece.item->after;
            } else {
                // On one line a new element is set off like the second of the old ones.
                const std::size_t model = i == 0 || items.size() < 2 ? 0 : 1;
                out_ += oneLine ? std::string(items.size() < 2 && i > 0 ? spaceAfterComma(layout)
                                                                        : items[model].before)
                                : layout.lineStart + layout.step;
                if (open == '{') out_ += Json(piece.name).dump() + layout.colon;
                fresh(*piece.after, layout.deeper());
            }
        }
        out_ += items.back().after;
        out_ += close;
    }

    static std::string_view spaceAfterComma(const Layout& layout) {
        return layout.colon.ends_with(' ') ? std::string_view(" ") : std::string_view();
    }

    void object(std::string_view source, const Json& before, const Json& after, const Layout& outer) {
        const std::vector<Item> items = itemsOf(source);
        // Of members that share a name the last one counts for the parser.
        std::map<std::string_view, const Item*> last;
        for (const Item& item : items)
            last[item.name] = &item;
        std::vector<Piece> wanted;
        for (const Item& item : items) {
            const auto kept = after.find(item.name);
            if (kept != after.end() && last[item.name] == &item)
                wanted.push_back({&item, item.name, &before.at(item.name), &*kept});
        }
        for (const auto& [name, member] : after.items()) {
            if (!before.contains(name)) wanted.push_back({nullptr, name, nullptr, &member});
        }
        pieces('{', '}', items, wanted, outer);
    }

    // Elements are matched from both ends, so that one that is added or removed leaves its neighbours alone.
    void array(std::string_view source, const Json& before, const Json& after, const Layout& outer) {
        const std::vector<Item> items = itemsOf(source);
        assert(items.size() == before.size());
        const std::size_t shorter = std::min(before.size(), after.size());
        std::size_t tail = 0, head = 0;
        if (before.size() != after.size()) {
            while (head < shorter && before[head] == after[head])
                ++head;
            while (tail < shorter - head &&
                   before[before.size() - 1 - tail] == after[after.size() - 1 - tail])
                ++tail;
        }
        std::vector<Piece> wanted;
        for (std::size_t i = 0; i < after.size(); ++i) {
            const bool inTail = i + tail >= after.size();
            const std::size_t old = inTail ? before.size() - (after.size() - i) : i;
            const bool hasOld = inTail || i < before.size() - tail;
            wanted.push_back(
                {hasOld ? &items[old] : nullptr, "", hasOld ? &before[old] : nullptr, &after[i]});
        }
        pieces('[', ']', items, wanted, outer);
    }

    // A value that has no old text. Short arrays of numbers stay on one line.
    void fresh(const Json& value, const Layout& layout) {
        const bool isPlain = !value.is_structured() || value.empty();
        const bool isNumbers =
            value.is_array() && value.size() <= 16 &&
            std::all_of(value.begin(), value.end(), [](const Json& e) { return e.is_number(); });
        if (isPlain || (isNumbers && !layout.hasLines())) {
            out_ += value.dump();
            return;
        }
        if (isNumbers) {
            for (std::size_t i = 0; i < value.size(); ++i)
                out_ += (i == 0 ? "[" : ", ") + value[i].dump();
            out_ += ']';
            return;
        }
        out_ += value.is_object() ? '{' : '[';
        bool first = true;
        for (auto it = value.begin(); it != value.end(); ++it) {
            if (!first) out_ += layout.hasLines() ? "," : "," + std::string(spaceAfterComma(layout));
            first = false;
            if (layout.hasLines()) out_ += layout.lineStart + layout.step;
            if (value.is_object()) out_ += Json(it.key()).dump() + layout.colon;
            fresh(*it, layout.deeper());
        }
        if (layout.hasLines()) out_ += layout.lineStart;
        out_ += value.is_object() ? '}' : ']';
    }

    std::string& out_;
};

} // namespace

std::string rewriteJson(std::string_view source, const nlohmann::json& before, const nlohmann::json& after) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    std::string out;
    if (source.starts_with(kByteOrderMark)) {
        out += kByteOrderMark;
        source.remove_prefix(kByteOrderMark.size());
    }
    Cursor cursor(source);
    out += cursor.space();
    const std::string_view root = cursor.value();
    Rewriter(out).value(root, before, after, Layout{});
    out += source.substr(cursor.position());
    return out;
}

} // namespace kilolux
