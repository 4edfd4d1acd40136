// What is derived from an object of the document and is made once, however many lights use it.
#pragma once

#include <map>
#include <memory>
#include <mutex>

namespace kilolux {

// By the document's object that it was made from, as long as that lives.
template<typename Source, typename Made>
class MadeOnce {
  public:
    template<typename Make>
    std::shared_ptr<const Made> get(const std::shared_ptr<const Source>& source, const Make& make) {
        const std::lock_guard lock(mutex_);
        std::erase_if(made_, [](const auto& entry) { return entry.second.source.expired(); });
        Entry& entry = made_[source.get()];
        if (!entry.made) entry = {source, std::make_shared<const Made>(make(*source))};
        return entry.made;
    }

  private:
    struct Entry {
        std::weak_ptr<const Source> source;
        std::shared_ptr<const Made> made;
    };
    std::mutex mutex_;
    std::map<const Source*, Entry> made_;
};

} // namespace kilolux
