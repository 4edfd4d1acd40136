// How a long task tells how far it has come, and learns that nobody waits for it any more. One thread works,
// others look.
#pragma once

#include <atomic>

namespace kilolux {

class TaskWatch {
  public:
    // --- of those who wait
    void cancel() { cancelled_ = true; }
    void rearm() { cancelled_ = false; } // for the next task of the same worker
    const char* doing() const { return doing_; }
    double share() const { return share_; } // of the whole task, 0 to 1

    // --- of the task. `doing`: words for the user, which outlive the watch.
    void reach(const char* doing, double share) {
        doing_ = doing;
        share_ = share;
    }
    bool isCancelled() const { return cancelled_; }

  private:
    std::atomic<bool> cancelled_ = false;
    std::atomic<const char*> doing_ = "";
    std::atomic<double> share_ = 0.0;
};

} // namespace kilolux
