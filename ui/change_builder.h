// Collects the edits of one change to several lights: each is made against the document as the ones before it
// left it, on a copy that is thrown away.
#pragma once

#include "renderer/document/edit_build.h"

#include <string_view>

namespace kilolux {

class ChangeBuilder {
  public:
    explicit ChangeBuilder(const Scene& scene) : scratch_(scene) {}

    // The document with all edits so far. World transforms are those from before.
    const Scene& scene() const { return scratch_; }

    // After the first error nothing more is taken.
    void take(const Edits& edits);
    void set(EditTarget target, std::uint64_t id, std::string_view field, EditValue value,
             Sharing sharing = Sharing::MakeUnique);

    Result<Edits> finish();

  private:
    Scene scratch_;
    Edits edits_;
    std::optional<Error> error_;
};

} // namespace kilolux
