// A change that is refused, with what to do instead.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace forage::model {

/// What the functions that change a system throw when another value would be taken.
class Refused : public std::invalid_argument {
  public:
    Refused(const std::string& message, std::string hint)
        : std::invalid_argument(message), hint_(std::move(hint)) {}
    const std::string& hint() const { return hint_; }

  private:
    std::string hint_;
};

}  // namespace forage::model
