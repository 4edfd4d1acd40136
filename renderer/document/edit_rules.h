// What must hold of a document after a change. Internal to renderer/document, but for checkValue.
#pragma once

#include "renderer/document/edit.h"

namespace kilolux {

// Whether a value suits a field by itself: its kind, finite, within the bounds. The message says what was
// expected, without a place.
std::optional<Error> checkValue(const EditField& field, const EditValue& value);

// Whether what an edit has touched is sound as a whole: cone within cone, a unit that suits type and size,
// names of groups unique, references that exist. The message begins with what it is about.
std::optional<Error> checkTouched(const Scene& scene, const Edit& edit);

} // namespace kilolux
