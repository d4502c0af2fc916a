// Where a type shows what it does before it gets near a system.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "core/base/column.h"
#include "core/types/type_error.h"

namespace forage::plugin {

inline constexpr Index cells = 5;
inline constexpr Index margin = 64;  ///< numbers on both sides of what a type may write
inline constexpr int updates = 3;

/// A number that no type writes by chance.
inline constexpr std::uint64_t untouched = 0x7ff8'f0a6'e0b5'1d37;

/// Numbers with a margin that shows whether somebody wrote beside them.
class Fenced {
  public:
    explicit Fenced(Index size)
        : all_(static_cast<std::size_t>(size + 2 * margin), std::bit_cast<double>(untouched)), size_(size) {
        std::fill_n(data(), size, 0.0);
    }
    double* data() { return all_.data() + margin; }
    Column column() { return {data(), size_}; }
    bool whole() const {
        const auto same = [](double v) { return std::bit_cast<std::uint64_t>(v) == untouched; };
        return std::all_of(all_.begin(), all_.begin() + margin, same) &&
               std::all_of(all_.end() - margin, all_.end(), same);
    }

  private:
    std::vector<double> all_;
    Index size_;
};

inline bool all_whole(const std::deque<Fenced>& all) {
    return std::all_of(all.begin(), all.end(), [](const Fenced& f) { return f.whole(); });
}

/// What `update` does against the declaration, given that it may write to `stage` only.
template <class Update>
std::string watch(const std::deque<Fenced>& stage, Update update) {
    try {
        update();
    } catch (const TypeError& e) {
        return e.what();
    } catch (...) {
        return {};
    }
    return all_whole(stage) ? "" : "it writes beside its columns: it takes them for longer than they are";
}

}  // namespace forage::plugin
