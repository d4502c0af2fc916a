// Finds things in the plane by their place.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace forage::bug {

/// A rectangle with sides along the axes of the world, m.
struct Area {
    double min_x = 0, min_y = 0, max_x = 0, max_y = 0;

    /// The square around the point (x, y) whose sides are `reach` (m) away from it.
    static Area around(double x, double y, double reach) {
        return {x - reach, y - reach, x + reach, y + reach};
    }
    bool meets(const Area& other) const {
        return min_x <= other.max_x && other.min_x <= max_x && min_y <= other.max_y && other.min_y <= max_y;
    }
};

/// Items in square cells. A search costs as much as there are items near it, however many there are in all.
class Grid {
  public:
    /// Replaces all items. Item i covers areas[i]; cells have a side of `cell` (m), or more where the areas
    /// cover so much that there would be more than a few thousand cells.
    void assign(const std::vector<Area>& areas, double cell);

    /// Makes room for `items` small items that are anywhere, so that assign() does not allocate memory.
    void reserve(std::size_t items);

    /// Calls visit(i) once for each item whose area meets `area`, in the same order for the same items.
    template <class F>
    void visit(const Area& area, F&& visit) const {
        if (areas_.empty()) return;
        const int first_column = column(area.min_x), last_column = column(area.max_x);
        const int first_row = row(area.min_y), last_row = row(area.max_y);
        for (int r = first_row; r <= last_row; ++r)
            for (int c = first_column; c <= last_column; ++c) {
                const auto cell = static_cast<std::size_t>(r * columns_ + c);
                for (std::uint32_t k = begin_[cell]; k < begin_[cell + 1]; ++k) {
                    const Area& item = areas_[items_[k]];
                    // An item in several cells is visited in the first one that it shares with `area`.
                    if (c == std::max(first_column, column(item.min_x)) &&
                        r == std::max(first_row, row(item.min_y)) && item.meets(area))
                        visit(static_cast<std::size_t>(items_[k]));
                }
            }
    }

  private:
    static constexpr int max_cells = 64;  ///< per axis

    static int index(double distance, double cell, int count) {
        return static_cast<int>(std::clamp(distance / cell, 0.0, count - 1.0));
    }
    int column(double x) const { return index(x - min_x_, cell_, columns_); }
    int row(double y) const { return index(y - min_y_, cell_, rows_); }

    double min_x_ = 0, min_y_ = 0, cell_ = 1;
    int columns_ = 1, rows_ = 1;
    std::vector<Area> areas_;
    std::vector<std::uint32_t> begin_;  ///< per cell: its first entry in items_; one more at the end
    std::vector<std::uint32_t> items_;
};

}  // namespace forage::bug
