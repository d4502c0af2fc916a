// A fast reader of recorded tables, and the tolerance of their numbers.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/number.h"

namespace forage::test {

inline std::string read_text(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error("cannot read " + path.string());
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A table of text, row by row. The fields are views into the table, which must outlive them.
class Rows {
  public:
    /// The first line, the header, is skipped; '#' does not begin a comment.
    explicit Rows(const std::filesystem::path& path, char separator = ',')
        : text_(read_text(path)), separator_(separator) {
        take_line();
    }
    Rows(const Rows&) = delete;
    Rows& operator=(const Rows&) = delete;

    /// Splits the next line into `fields`; false at the end. An empty line is a row of one empty field.
    bool next(std::vector<std::string_view>& fields) {
        if (at_ >= text_.size()) return false;
        fields.clear();
        std::string_view line = take_line();
        for (auto cut = line.find(separator_); cut != std::string_view::npos; cut = line.find(separator_)) {
            fields.push_back(line.substr(0, cut));
            line.remove_prefix(cut + 1);
        }
        fields.push_back(line);
        return true;
    }

  private:
    std::string_view take_line() {
        const auto end = std::min(text_.find('\n', at_), text_.size());
        std::string_view line(text_.data() + at_, end - at_);
        at_ = end + 1;
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line;
    }

    std::string text_;
    char separator_;
    std::size_t at_ = 0;
};

/// A whole field as a number, which may be "nan" or "inf". Anything else is a mistake in the recording.
template <class N = double>
N number(std::string_view field) {
    std::string_view rest = field;
    const auto value = take_number<N>(rest);
    if (!value || !rest.empty()) throw std::runtime_error("'" + std::string(field) + "' is not a number");
    return *value;
}

/// Compares with the tolerance of the recordings. A NaN equals a NaN, and an infinity equals only itself.
inline bool same(double ours, double recorded, double tolerance = 1e-12) {
    if (std::isnan(recorded) || std::isnan(ours)) return std::isnan(recorded) && std::isnan(ours);
    if (std::isinf(recorded) || std::isinf(ours)) return ours == recorded;
    return std::abs(ours - recorded) <= tolerance * std::max(1.0, std::abs(recorded));
}

}  // namespace forage::test
