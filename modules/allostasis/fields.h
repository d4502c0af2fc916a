// The fields of the arena, and the day.
#pragma once

#include "modules/allostasis/needs.h"

namespace forage::allostasis {

/// A place in the arena, m; the original's arena is 3.5 m x 3.5 m with (0, 0) in its middle.
struct Place {
    double x = 0, y = 0;
};

/// The day: the temperature's step c rises from 0 to C = 200 s while it is day, when it gets colder, and
/// falls at night.
class Day {
  public:
    static constexpr double length = 200;  ///< C, s
    /// Returns c at `time`, s. Called with rising times.
    double step(double time);
    bool is_day() const { return day_; }
    void checkpoint(Archive& archive) { archive(day_, start_); }

  private:
    bool day_ = true;
    double start_ = 0;
};

/// The field of temperature: 360 rows of 1 cm, warm in the south.
class TemperatureField {
  public:
    explicit TemperatureField(int step = 0);
    double row(int y) const;  ///< at a row from the south
    double mean() const;

  private:
    double middle_;  ///< x0
};

/// The local views of all fields at the robot's place. `step` is the whole part of c. With `offset`, as in
/// the original, the fields of water and food lie 5 cm off their objects, towards the middle in x and y.
LocalViews local_views(Place robot, Place predator, Place mate, int step, bool offset = true);

}  // namespace forage::allostasis
