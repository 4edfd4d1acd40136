// An array that copies of a document share until one of them writes: copying costs a reference count, the
// first write after it a copy of the elements. Reads like a std::vector.
//
// A reference or iterator taken for writing must not outlive the next copy of the array: it would write into
// the copy as well.
#pragma once

#include <atomic>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace kilolux {

template<typename T>
class CopyOnWrite {
  public:
    using Vector = std::vector<T>;
    using value_type = T;
    using iterator = typename Vector::iterator;
    using const_iterator = typename Vector::const_iterator;

    CopyOnWrite() = default;
    CopyOnWrite(Vector elements) : shared_(std::make_shared<Vector>(std::move(elements))) {}
    CopyOnWrite(std::initializer_list<T> elements) : shared_(std::make_shared<Vector>(elements)) {}

    const Vector& read() const {
        static const Vector kNothing;
        return shared_ ? *shared_ : kNothing;
    }
    // The elements for writing, of this array alone.
    Vector& write() {
        if (!shared_) {
            shared_ = std::make_shared<Vector>();
        } else if (shared_.use_count() != 1) {
            shared_ = std::make_shared<Vector>(*shared_);
        } else {
            // The last other owner may have read on another thread until just now.
            std::atomic_thread_fence(std::memory_order_acquire);
        }
        return *shared_;
    }
    operator const Vector&() const { return read(); }
    operator Vector&() { return write(); }
    // Whether both are one array in memory: then they are equal without a look at the elements.
    bool sharesWith(const CopyOnWrite& other) const { return shared_ == other.shared_; }

    std::size_t size() const { return read().size(); }
    bool empty() const { return read().empty(); }
    const T& operator[](std::size_t i) const { return read()[i]; }
    T& operator[](std::size_t i) { return write()[i]; }
    const T& front() const { return read().front(); }
    T& front() { return write().front(); }
    const T& back() const { return read().back(); }
    T& back() { return write().back(); }
    const T* data() const { return read().data(); }
    T* data() { return write().data(); }
    const_iterator begin() const { return read().begin(); }
    const_iterator end() const { return read().end(); }
    iterator begin() { return write().begin(); }
    iterator end() { return write().end(); }
    void push_back(T value) { write().push_back(std::move(value)); }
    void pop_back() { write().pop_back(); }
    void resize(std::size_t count) { write().resize(count); }
    void reserve(std::size_t count) { write().reserve(count); }
    void clear() { shared_.reset(); }

  private:
    std::shared_ptr<Vector> shared_;
};

} // namespace kilolux
