#include "renderer/document/history.h"

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

std::optional<Error> History::cancel(Scene& scene) {
    if (!open_ || done_ != steps_.size()) return std::nullopt;
    if (std::optional<Error> error = undo(scene)) return error;
    steps_.resize(done_);
    return std::nullopt;
}

} // namespace kilolux
