// The positions of the cells of a group: x to the right, y downwards, both from 1.
#pragma once

#include <vector>

#include "core/model/system.h"

namespace forage::connectivity {

class Grid {
  public:
    explicit Grid(const model::Topology& topology);

    int width() const { return width_; }
    int height() const { return height_; }
    int cells() const { return cells_; }
    /// The index of the cell at (x, y), or -1 when there is none.
    int index(int x, int y) const {
        if (x < left_ || y < top_ || x >= left_ + width_ || y >= top_ + height_) return -1;
        const int place = (y - top_) * width_ + (x - left_);
        return rank_.empty() ? place : rank_[static_cast<std::size_t>(place)];
    }
    int left() const { return left_; }  ///< x of the leftmost cell
    int top() const { return top_; }    ///< y of the uppermost cell
    bool wraps_x() const { return wrap_x_; }
    bool wraps_y() const { return wrap_y_; }

  private:
    int left_ = 1, top_ = 1, width_ = 0, height_ = 0, cells_ = 0;
    bool wrap_x_ = false, wrap_y_ = false;
    std::vector<int> rank_;  ///< the cell index at each position of a sparse group, -1 for none
};

}  // namespace forage::connectivity
