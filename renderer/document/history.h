// Undo and redo. Every change goes through here; drags merge into one step.
#pragma once

#include "renderer/document/edit.h"

namespace kilolux {

enum class Merging { Allow, Never };

class History {
  public:
    // Applies the change and makes it the newest step; it joins the newest one where merging is allowed, both
    // have the same key and nothing has sealed it. What could be redone is forgotten.
    std::optional<Error> apply(Scene& scene, Change change, Merging merging = Merging::Allow);

    // Whether the next change of that key would join the newest step.
    bool wouldMerge(std::string_view mergeKey) const;

    std::optional<Error> undo(Scene& scene); // nothing to undo is an error
    std::optional<Error> redo(Scene& scene);

    // Ends a drag: the newest step takes no more changes.
    void seal() { open_ = false; }
    // Gives a drag up: undoes the newest step if it is still open, without leaving it for redo.
    std::optional<Error> cancel(Scene& scene);

    bool canUndo() const { return done_ > 0; }
    bool canRedo() const { return done_ < steps_.size(); }
    std::string undoName() const { return canUndo() ? steps_[done_ - 1].change.name : ""; }
    std::string redoName() const { return canRedo() ? steps_[done_].change.name : ""; }

    // The steps from the oldest on, those that can be redone last; the first doneSteps() are in effect.
    std::size_t steps() const { return steps_.size(); }
    std::size_t doneSteps() const { return done_; }
    const std::string& stepName(std::size_t step) const { return steps_[step].change.name; }

    // What undo() and redo() would apply, as a change of its own; without edits where there is nothing.
    Change nextUndo() const;
    Change nextRedo() const;

    // Applies a change that was an undo or redo when it was made: as one where that is the newest step again,
    // else as a step of its own.
    std::optional<Error> replayUndo(Scene& scene, Change change);
    std::optional<Error> replayRedo(Scene& scene, Change change);

    // Names the present state: equal again after undo and redo, different after every change.
    std::uint64_t state() const { return done_ > 0 ? steps_[done_ - 1].state : 0; }

  private:
    struct Step {
        Change change;
        std::uint64_t state = 0;
    };
    std::vector<Step> steps_;
    std::size_t done_ = 0; // steps in effect; those behind can be redone
    std::uint64_t lastState_ = 0;
    bool open_ = false;
};

} // namespace kilolux
