// What a user sets once, for all studios.
#pragma once

namespace forage::studio {

struct Settings {
    double save_interval = 20;  ///< s between two savings of a session that runs, in [5, 60]
};

/// Those that were written last; the defaults where there are none, or none that can be read.
Settings read_settings();
/// Writes $XDG_STATE_HOME/forage/settings.json. Throws InputError for a value out of its range, and
/// std::runtime_error where the file cannot be written.
void write_settings(const Settings& settings);

}  // namespace forage::studio
