// Result<T>: a value or one message for the user. A message names the file, the place in it and what was
// expected, in one line.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace kilolux {

struct Error {
    std::string message;
};

template<typename T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::move(value)) {}
    Result(Error error) : state_(std::move(error)) {}

    explicit operator bool() const { return std::holds_alternative<T>(state_); }
    T& value() {
        assert(*this);
        return std::get<T>(state_);
    }
    const T& value() const {
        assert(*this);
        return std::get<T>(state_);
    }
    const std::string& error() const { return std::get<Error>(state_).message; }

  private:
    std::variant<T, Error> state_;
};

} // namespace kilolux
