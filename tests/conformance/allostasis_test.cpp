// The parts of the allostatic reactive layer, driven by recorded input, give the recorded numbers. The
// recordings are not part of the project: the tests look for them in the folder `golden/allostasis` of
// shared_dir().
#include <cstring>
#include <map>

#include "modules/allostasis/fields.h"
#include "modules/allostasis/steering.h"
#include "tests/support/catch.h"
#include "tests/support/recorded_cases.h"

using namespace forage;
using namespace forage::test;
using namespace forage::allostasis;
using Eigen::Index;

namespace {

using Path = std::filesystem::path;
using Fields = std::vector<std::string_view>;

/// A table with named columns.
class Recording {
  public:
    explicit Recording(const Path& path) : rows_(path) {
        std::string header = read_text(path);
        header.resize(header.find('\n'));
        for (std::size_t at = 0, column = 0; at <= header.size(); ++column) {
            const auto end = std::min(header.find(',', at), header.size());
            columns_[header.substr(at, end - at)] = column;
            at = end + 1;
        }
    }
    bool next() { return rows_.next(fields_); }
    std::string_view text(const std::string& column) const { return fields_.at(columns_.at(column)); }
    bool empty(const std::string& column) const { return text(column).empty(); }
    double operator[](const std::string& column) const { return number(text(column)); }

  private:
    Rows rows_;
    std::map<std::string, std::size_t> columns_;
    Fields fields_;
};

std::vector<Path> cases_with(const std::string& file) {
    std::map<std::string, Path> out;
    for (const auto& folder : trace_folders("allostasis")) {
        if (!std::filesystem::exists(folder)) continue;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (std::filesystem::exists(entry.path() / file))
                out.emplace(entry.path().filename().string(), entry.path());
    }
    std::vector<Path> paths;
    for (const auto& [name, path] : out) paths.push_back(path);
    if (paths.empty()) absent(shared_dir() / "golden/allostasis");
    return paths;
}

std::map<std::string, std::string> parameters(const Path& path) {
    std::map<std::string, std::string> out;
    Recording table(path / "params.csv");
    // A note may hold commas; it is not used.
    while (table.next()) out[std::string(table.text("name"))] = std::string(table.text("value"));
    return out;
}

/// The steps in a text such as "\"300 600\"".
std::vector<int> steps(std::string text) {
    std::erase(text, '"');
    std::vector<int> out;
    for (const char* at = text.c_str(); *at;) {
        char* end = nullptr;
        out.push_back(static_cast<int>(std::strtol(at, &end, 10)));
        at = end + std::strspn(end, " ");
    }
    return out;
}

const std::array<std::string, 5> need_names{"temperature", "hydration", "energy", "security", "mating"};

LocalViews views_of(const Recording& row) {
    LocalViews views;
    for (int i = 0; i < needs; ++i)
        for (int q = 0; q < 4; ++q)
            views(i, q) = row[need_names[static_cast<std::size_t>(i)] + "_q" + std::to_string(q)];
    return views;
}

bool contains(const std::vector<int>& all, int step) {
    return std::find(all.begin(), all.end(), step) != all.end();
}

struct AllostasisComparison {
    std::string problem;
    void equal(const std::string& what, double ours, double recorded, double tolerance = 1e-12) {
        if (problem.empty() && !same(ours, recorded, tolerance))
            problem = what + ": " + std::to_string(ours) + ", recorded " + std::to_string(recorded);
    }
};

}  // namespace

TEST_CASE("The network of the drives gives the recorded rates") {
    for (const auto& path : cases_with("inputs.csv")) {
        INFO(path.filename());
        const auto p = parameters(path);
        const auto real = [&](const char* name) { return number(p.at(name)); };
        const NetworkSettings settings{real("dt"), real("tau"), real("we"),  real("wmi"),  real("wsi"),
                                       real("q"),  real("a"),   real("thr"), real("fmax"), real("var")};
        const auto units = number<Index>(p.at("units"));
        const auto resets = steps(p.at("reset_before_steps"));
        std::map<int, Eigen::ArrayXd> inputs;
        for (Recording t(path / "inputs.csv"); t.next();) {
            Eigen::ArrayXd values(units);
            for (Index i = 0; i < units; ++i) values[i] = t["I[" + std::to_string(i) + "]"];
            inputs[static_cast<int>(t["step"])] = values;
        }
        std::unique_ptr<Recording> noise;
        if (std::filesystem::exists(path / "noise.csv"))
            noise = std::make_unique<Recording>(path / "noise.csv");
        Eigen::ArrayXd rates = Eigen::ArrayXd::Zero(units), z = rates, input = rates;
        AllostasisComparison c;
        int compared = 0;
        for (Recording out(path / "outputs.csv"); out.next() && c.problem.empty(); ++compared) {
            const int now = static_cast<int>(out["step"]);
            if (contains(resets, now)) rates.setZero();
            if (const auto found = inputs.find(now); found != inputs.end()) input = found->second;
            if (noise) {
                REQUIRE(noise->next());
                for (Index i = 0; i < units; ++i) z[i] = (*noise)["z[" + std::to_string(i) + "]"];
            }
            step_network(rates, input, z, settings);
            for (Index i = 0; i < units; ++i)
                c.equal("step " + std::to_string(now), rates[i], out["U[" + std::to_string(i) + "]"], 1e-10);
        }
        CHECK(c.problem == "");
        CHECK(compared == number<int>(p.at("steps")));
    }
}

TEST_CASE("Needs, drives and forces are the recorded ones") {
    for (const auto& path : cases_with("local_views.csv")) {
        INFO(path.filename());
        const auto p = parameters(path);
        NeedSettings settings;
        settings.setpoint = number(p.at("setpoint"));
        settings.recovery = number(p.at("bonus"));
        settings.gain = number(p.at("amplifier"));
        for (int i = 0; i < needs; ++i) {
            const auto& name = need_names[static_cast<std::size_t>(i)];
            settings.priority[i] = number(p.at(name + "_priority"));
            if (i != security) settings.decay[i] = number(p.at(name + "_discount"));
        }
        const auto restarts = steps(p.at("restart_before_steps"));
        std::map<int, LocalViews> views;
        for (Recording t(path / "local_views.csv"); t.next();)
            views[static_cast<int>(t["step"])] = views_of(t);
        Recording noise(path / "noise.csv");
        Drives drives;
        AllostasisComparison c;
        int compared = 0;
        for (Recording out(path / "outputs.csv"); out.next() && c.problem.empty(); ++compared) {
            const int now = static_cast<int>(out["step"]);
            if (const auto found = views.find(now); found != views.end())
                drives.sense(found->second, settings);
            if (contains(restarts, now)) drives.restart();
            REQUIRE(noise.next());
            FiveNeeds z;
            for (int i = 0; i < needs; ++i) z[i] = noise["z_" + need_names[static_cast<std::size_t>(i)]];
            drives.step(z, settings, {});
            const std::string where = "step " + std::to_string(now) + ", ";
            c.equal(where + "normaliser", drives.normaliser(), out["normaliser"]);
            for (int i = 0; i < needs; ++i) {
                const auto& name = need_names[static_cast<std::size_t>(i)];
                c.equal(where + name, drives.states()[i], out["is_" + name]);
                c.equal(where + "force of " + name, drives.forces()[i], out["force_" + name]);
            }
        }
        CHECK(c.problem == "");
        CHECK(compared == number<int>(p.at("steps")));
    }
}

TEST_CASE("Fields and local views are the recorded ones") {
    for (const auto& path : cases_with("views.csv")) {
        AllostasisComparison c;
        int compared = 0;
        for (Recording t(path / "views.csv"); t.next(); ++compared) {
            const std::string where = "row " + std::string(t.text("row")) + ", ";
            const int now = static_cast<int>(t["temperature_step"]);
            const auto views = local_views({t["x"], t["y"]}, {t["predator_x"], t["predator_y"]},
                                           {t["mate_x"], t["mate_y"]}, now);
            const auto recorded = views_of(t);
            c.equal(where + "mean temperature", TemperatureField(now).mean(), t["mean_temperature"]);
            for (int i = 0; i < needs; ++i)
                for (int q = 0; q < 4; ++q)
                    c.equal(where + need_names[static_cast<std::size_t>(i)], views(i, q), recorded(i, q));
        }
        CHECK(c.problem == "");
        CHECK(compared > 0);
    }
}

TEST_CASE("The day passes as recorded") {
    for (const auto& path : cases_with("day.csv")) {
        AllostasisComparison c;
        Day day;
        for (Recording t(path / "day.csv"); t.next();) {
            const std::string where = "row " + std::string(t.text("row")) + ", ";
            c.equal(where + "c", day.step(t["time"]), t["cycle_temperature"]);
            c.equal(where + "day", day.is_day(), t["day"]);
        }
        CHECK(c.problem == "");
    }
}

TEST_CASE("Steering turns as recorded") {
    for (const auto& path : cases_with("steering.csv")) {
        AllostasisComparison c;
        Steering steering;
        for (Recording t(path / "steering.csv"); t.next();) {
            const std::string where = "row " + std::string(t.text("row")) + ", ";
            FiveNeeds forces;
            for (int i = 0; i < needs; ++i) forces[i] = t["force_" + need_names[static_cast<std::size_t>(i)]];
            const auto wheels =
                steering.step(t["bearing"], views_of(t), forces, 1, true, t["u_right"], t["u_left"]);
            for (int i = 0; i < needs; ++i) {
                const auto& name = need_names[static_cast<std::size_t>(i)];
                c.equal(where + "side of " + name, steering.sides()[i], t["side_" + name], 0);
                c.equal(where + "direction of " + name, steering.directions()[i], t["sign_" + name], 0);
            }
            c.equal(where + "right wheel", wheels.right, t["wheel_right"]);
            c.equal(where + "left wheel", wheels.left, t["wheel_left"]);
        }
        CHECK(c.problem == "");
    }
}

TEST_CASE("Wheels hold a command and turn from obstacles as recorded") {
    for (const auto& path : cases_with("wheels.csv")) {
        INFO(path.filename());
        const bool control = parameters(path).at("allostatic") == "0";
        AllostasisComparison c;
        WheelControl wheels;
        for (Recording t(path / "wheels.csv"); t.next();) {
            Wheels z;
            if (control) z = {t["z_right"], t["z_left"]};
            const auto out = wheels.step(t["time"], {t["ps0"], t["ps1"], t["ps6"], t["ps7"]},
                                         {t["wish_right"], t["wish_left"]}, z);
            const std::string where = "step " + std::string(t.text("step")) + ", ";
            c.equal(where + "right", out.right, t["wheel_right"]);
            c.equal(where + "left", out.left, t["wheel_left"]);
        }
        CHECK(c.problem == "");
    }
}

TEST_CASE("Mate and predator walk as recorded") {
    for (const auto& path : cases_with("walk.csv")) {
        INFO(path.filename());
        const bool mate = path.filename().string().find("mate") != std::string::npos;
        AllostasisComparison c;
        RandomWalk walk;
        for (Recording t(path / "walk.csv"); t.next();) {
            Eigen::Array<double, 8, 1> ranges;
            for (int i = 0; i < 8; ++i) ranges[i] = t["ps" + std::to_string(i)];
            const bool drawn = !t.empty("z_right");
            const auto out = walk.step(ranges, drawn ? Wheels{t["z_right"], t["z_left"]} : Wheels{},
                                       mate ? mate_walk : predator_walk);
            const std::string where = "step " + std::string(t.text("step")) + ", ";
            c.equal(where + "drawn", walk.drew(), drawn, 0);
            c.equal(where + "right", out.right, t["wheel_right"]);
            c.equal(where + "left", out.left, t["wheel_left"]);
        }
        CHECK(c.problem == "");
    }
}
