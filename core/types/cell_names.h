// What the cells of a group stand for, in words, for plots and tables.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace forage {

/// Names of the columns and rows of a group. A cell has those of its row and of its column: "red, left".
struct CellNames {
    std::vector<std::string> columns = {}, rows = {};  ///< a name each; empty: they are only numbered
    std::string column = {}, row = {};  ///< what numbered columns and rows are: "segment", "sequence"

    bool any() const { return !columns.empty() || !rows.empty() || !column.empty() || !row.empty(); }
    /// The name of the cell in a column and a row, counted from 1: "sequence 3, segment 5". Empty without
    /// one.
    std::string of(int x, int y) const {
        const auto part = [](const std::vector<std::string>& all, const std::string& what, int number) {
            const auto i = static_cast<std::size_t>(number - 1);
            if (i < all.size()) return all[i];
            return what.empty() ? std::string() : what + " " + std::to_string(number);
        };
        std::string out = part(rows, row, y);
        const std::string across = part(columns, column, x);
        if (!out.empty() && !across.empty()) out += ", ";
        return out + across;
    }
    friend bool operator==(const CellNames&, const CellNames&) = default;
};

}  // namespace forage
