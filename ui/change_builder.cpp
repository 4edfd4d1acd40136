#include "ui/change_builder.h"

namespace kilolux {

void ChangeBuilder::take(const Edits& edits) {
    for (const Edit& edit : edits) {
        if (error_) return;
        error_ = applyInPlace(scratch_, edit);
        edits_.push_back(edit);
    }
}

void ChangeBuilder::set(EditTarget target, std::uint64_t id, std::string_view field, EditValue value,
                        Sharing sharing) {
    if (error_) return;
    Result<Edits> edits = setField(scratch_, target, id, field, std::move(value), sharing);
    if (edits) {
        take(edits.value());
    } else {
        error_ = Error{edits.error()};
    }
}

Result<Edits> ChangeBuilder::finish() {
    if (error_) return *error_;
    return std::move(edits_);
}

} // namespace kilolux
