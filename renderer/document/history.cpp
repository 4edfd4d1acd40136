#include "renderer/document/history.h"

#include <algorithm>
#include <map>

namespace kilolux {

namespace {

bool isWhole(const Edit& edit) {
    return edit.field == nullptr;
}

// Takes a later change into an earlier one: each field keeps its first value before and its last one after.
void join(Change& step, Change change) {
    std::map<std::pair<const EditField*, std::uint64_t>, std::size_t> places;
    for (std::size_t i = 0; i < step.edits.size(); ++i) {
        const Edit& edit = step.edits[i];
        if (!isWhole(edit)) places[{edit.field, edit.id}] = i;
    }
    for (Edit& edit : change.edits) {
        const auto found = isWhole(edit) ? places.end() : places.find({edit.field, edit.id});
        if (found != places.end()) {
            step.edits[found->second].after = std::move(edit.after);
        } else {
            step.edits.push_back(std::move(edit));
        }
    }
}

bool sameEdits(const std::vector<Edit>& a, const std::vector<Edit>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Edit& x, const Edit& y) {
        return x.target == y.target && x.id == y.id && x.field == y.field && sameValue(x.before, y.before) &&
               sameValue(x.after, y.after);
    });
}

} // namespace

bool History::wouldMerge(std::string_view mergeKey) const {
    return open_ && done_ > 0 && done_ == steps_.size() && !mergeKey.empty() &&
           steps_[done_ - 1].change.mergeKey == mergeKey;
}

std::optional<Error> History::apply(Scene& scene, Change change, Merging merging) {
    if (std::optional<Error> error = applyEdits(scene, change.edits)) return error;
    const bool merges = merging == Merging::Allow && wouldMerge(change.mergeKey);
    steps_.resize(done_);
    open_ = !change.mergeKey.empty();
    if (merges) {
        join(steps_.back().change, std::move(change));
    } else {
        steps_.push_back({std::move(change), 0});
        ++done_;
    }
    steps_.back().state = ++lastState_;
    return std::nullopt;
}

std::optional<Error> History::undo(Scene& scene) {
    if (!canUndo()) return Error{"there is nothing to undo"};
    if (std::optional<Error> error = revertEdits(scene, steps_[done_ - 1].change.edits)) return error;
    --done_;
    open_ = false;
    return std::nullopt;
}

std::optional<Error> History::redo(Scene& scene) {
    if (!canRedo()) return Error{"there is nothing to redo"};
    if (std::optional<Error> error = applyEdits(scene, steps_[done_].change.edits)) return error;
    ++done_;
    open_ = false;
    return std::nullopt;
}

Change History::nextUndo() const {
    Change change;
    if (!canUndo()) return change;
    const Change& step = steps_[done_ - 1].change;
    change.name = "Undo " + step.name;
    for (auto edit = step.edits.rbegin(); edit != step.edits.rend(); ++edit)
        change.edits.push_back(inverted(*edit));
    return change;
}

Change History::nextRedo() const {
    if (!canRedo()) return {};
    return {"Redo " + steps_[done_].change.name, "", steps_[done_].change.edits};
}

std::optional<Error> History::replayUndo(Scene& scene, Change change) {
    if (canUndo() && sameEdits(nextUndo().edits, change.edits)) return undo(scene);
    return apply(scene, std::move(change), Merging::Never);
}

std::optional<Error> History::replayRedo(Scene& scene, Change change) {
    if (canRedo() && sameEdits(nextRedo().edits, change.edits)) return redo(scene);
    return apply(scene, std::move(change), Merging::Never);
}

std::optional<Error> History::cancel(Scene& scene) {
    if (!open_ || done_ != steps_.size()) return std::nullopt;
    if (std::optional<Error> error = undo(scene)) return error;
    steps_.resize(done_);
    return std::nullopt;
}

} // namespace kilolux
