// Compares every synapse of every recorded case: its cells, order, distance, delay and attenuation.
#include <algorithm>
#include <map>
#include <set>

#include "core/connectivity/connect.h"
#include "core/connectivity/grid.h"
#include "core/model/lookup.h"
#include "core/xml/reader.h"
#include "tests/support/catch.h"
#include "tests/support/recorded_cases.h"

using namespace forage;

namespace {

struct Synapse {
    int pre, post;
    double distance;
    int delay;
    double attenuation;
};

using List = std::vector<Synapse>;

/// The recorded synapses, by the connection's id.
std::map<std::string, List> recorded_synapses(const std::filesystem::path& path) {
    std::map<std::string, List> out;
    test::Rows rows(path);
    for (std::vector<std::string_view> f; rows.next(f);) {
        // A name may contain commas, so the fields after it are counted from the end.
        const auto n = f.size();
        out[std::string(f[0])].push_back({test::number<int>(f[n - 5]), test::number<int>(f[n - 4]),
                                          test::number(f[n - 3]), test::number<int>(f[n - 2]),
                                          test::number(f[n - 1])});
    }
    return out;
}

List as_list(const connectivity::Synapses& s) {
    List out;
    for (std::size_t i = 0; i < s.size(); ++i)
        out.push_back({s.pre[i], s.post[i], s.distance[i], s.delay[i], s.attenuation[i]});
    return out;
}

/// The parts of a connection that depend on random numbers. All other parts are compared exactly.
struct Random {
    bool choice, thinned, attenuation, delay;
    explicit Random(const model::Connection& c)
        : choice(std::holds_alternative<model::RandomArbor>(c.arborization.shape)),
          thinned(c.arborization.probability < 1),
          attenuation(std::holds_alternative<model::RandomFunction>(c.attenuation.form)),
          delay(std::holds_alternative<model::RandomFunction>(c.delay.form)) {}
    bool any() const { return choice || thinned || attenuation || delay; }
};

std::string describe(const Synapse& s) {
    return std::to_string(s.pre) + " -> " + std::to_string(s.post) + ", distance " +
           std::to_string(s.distance) + ", delay " + std::to_string(s.delay) + ", attenuation " +
           std::to_string(s.attenuation);
}

/// The first difference in the parts that do not depend on random numbers; empty when there is none.
std::string first_difference(const List& ours, const List& recorded, const Random& random) {
    if (ours.size() != recorded.size())
        return std::to_string(ours.size()) + " synapses, recorded were " + std::to_string(recorded.size());
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const Synapse &a = ours[i], &b = recorded[i];
        if (a.pre != b.pre || a.post != b.post || !test::same(a.distance, b.distance) ||
            (!random.delay && a.delay != b.delay) ||
            (!random.attenuation && !test::same(a.attenuation, b.attenuation)))
            return "synapse " + std::to_string(i) + ": " + describe(a) + "; recorded was " + describe(b);
    }
    return {};
}

/// Whether `part` is `whole` with some synapses left out, in the same order.
bool is_subsequence(const List& part, const List& whole) {
    auto at = whole.begin();
    for (const Synapse& s : part) {
        at = std::find_if(at, whole.end(), [&](const Synapse& w) {
            return w.pre == s.pre && w.post == s.post && test::same(s.distance, w.distance);
        });
        if (at == whole.end()) return false;
        ++at;
    }
    return true;
}

/// |a - b| of two counts drawn alike, in standard deviations of their difference.
double deviation(double a, double b) { return std::abs(a - b) / std::sqrt(std::max(1.0, a + b)); }

double mean(const List& list, double (*value)(const Synapse&)) {
    double sum = 0;
    for (const auto& s : list) sum += value(s);
    return sum / static_cast<double>(list.size());
}

class Comparison {
  public:
    Comparison(const model::System& system) : groups_(system) {}

    List connect(const model::Connection& c, std::uint64_t seed = 1) {
        Diagnostics diagnostics;
        List out =
            as_list(connectivity::connect(c, topology(c.source), topology(c.target), seed, diagnostics));
        INFO(format(diagnostics));
        CHECK_FALSE(diagnostics.failed());
        return out;
    }

    /// Compares the parts of a random connection that do not depend on the seed, and the statistics of the
    /// others.
    void statistics(const model::Connection& c, const List& recorded, const Random& random) {
        const List ours = connect(c), other_seed = connect(c, 2);
        if (random.thinned) {
            model::Connection whole = c;
            whole.arborization.probability = 1;
            const List all = connect(whole);
            CHECK(is_subsequence(ours, all));
            CHECK(is_subsequence(recorded, all));
            // Kept when a whole number drawn from 0..100 is at most 100 p.
            const double p = (std::floor(c.arborization.probability * 100) + 1) / 101;
            const auto n = static_cast<double>(all.size());
            const double sigma = std::sqrt(n * p * (1 - p));
            CHECK(std::abs(static_cast<double>(ours.size()) - n * p) < 4 * sigma);
            CHECK(std::abs(static_cast<double>(recorded.size()) - n * p) < 4 * sigma);
        } else if (random.choice) {
            CHECK(ours.size() == recorded.size());
            check_choice(ours, recorded, c);
        } else {
            CHECK(first_difference(ours, recorded, random).empty());
            CHECK(first_difference(other_seed, recorded, random).empty());
        }
        if (random.attenuation) {
            const auto value = [](const Synapse& s) { return s.attenuation; };
            const double max = std::get<model::RandomFunction>(c.attenuation.form).max;
            for (const auto& s : ours) {
                CHECK((s.attenuation >= 0 && s.attenuation <= max));
                CHECK(std::abs(s.attenuation * 1e4 - std::round(s.attenuation * 1e4)) <
                      1e-9);  // steps of 1e-4
            }
            const double sigma = max / std::sqrt(12.0 * static_cast<double>(ours.size()));
            CHECK(std::abs(mean(ours, value) - mean(recorded, value)) < 4 * std::sqrt(2.0) * sigma);
        }
        if (random.delay) {
            std::map<int, std::array<double, 2>> histogram;
            for (const auto& s : ours) ++histogram[s.delay][0];
            for (const auto& s : recorded) ++histogram[s.delay][1];
            for (const auto& [delay, count] : histogram) {
                INFO("delay " << delay << ": " << count[0] << " times, recorded " << count[1]);
                CHECK(deviation(count[0], count[1]) < 4);
            }
        }
        const auto differ = [](const Synapse& a, const Synapse& b) {
            return a.pre != b.pre || a.post != b.post || a.delay != b.delay ||
                   !test::same(a.attenuation, b.attenuation);
        };
        CHECK((!varies(c, random) || ours.size() != other_seed.size() ||
               !std::equal(ours.begin(), ours.end(), other_seed.begin(), std::not_fn(differ))));
    }

    /// Whether another seed gives other synapses: some random functions have one value only, and all cells
    /// may be chosen.
    bool varies(const model::Connection& c, const Random& random) const {
        const auto* chosen = std::get_if<model::RandomArbor>(&c.arborization.shape);
        const bool receptive = c.arborization.direction == model::Direction::receptive;
        const connectivity::Grid choice(topology(receptive ? c.source : c.target));
        return random.thinned || (chosen && chosen->count < choice.cells()) ||
               (random.attenuation && std::get<model::RandomFunction>(c.attenuation.form).max > 0) ||
               (random.delay && std::get<model::RandomFunction>(c.delay.form).max >= 1);
    }

    const model::Topology& topology(const std::string& id) const { return groups_.find(id).group->topology; }

  private:
    /// Each cell that is not spread gets the same number of distinct partners as in the recording, and over
    /// all of them no partner is preferred.
    void check_choice(const List& ours, const List& recorded, const model::Connection& c) const {
        const bool receptive = c.arborization.direction == model::Direction::receptive;
        const auto partners = [receptive](const List& list) {
            std::map<int, std::multiset<int>> out;
            for (const auto& s : list) out[receptive ? s.post : s.pre].insert(receptive ? s.pre : s.post);
            return out;
        };
        const auto mine = partners(ours), theirs = partners(recorded);
        CHECK(mine.size() == theirs.size());
        std::map<int, double> uses;
        for (const auto& [cell, chosen] : mine) {
            CHECK(std::set<int>(chosen.begin(), chosen.end()).size() == chosen.size());
            CHECK(theirs.count(cell) == 1);
            if (theirs.count(cell)) CHECK(chosen.size() == theirs.at(cell).size());
            for (const int partner : chosen) ++uses[partner];
        }
        const connectivity::Grid choice(topology(receptive ? c.source : c.target));
        const double expected = static_cast<double>(ours.size()) / choice.cells();
        for (const auto& [partner, n] : uses) CHECK(std::abs(n - expected) < 4 * std::sqrt(expected) + 1);
    }

    model::GroupIndex groups_;
};

void compare(const test::Case& one) {
    INFO(one.name << " (" << one.status << ") " << one.note);
    Diagnostics diagnostics;
    const auto system = xml::read_system((one.path / "input.iqr").string(), diagnostics);
    INFO(format(diagnostics));
    if (one.status == "original-crashes" && !system) {
        CHECK(diagnostics.failed());
        return;
    }
    REQUIRE(system);
    Comparison comparison(*system);
    if (one.status != "ok") {
        for (const auto& c : system->connections)
            connectivity::connect(c, comparison.topology(c.source), comparison.topology(c.target), 1,
                                  diagnostics);
        CHECK(diagnostics.failed());
        return;
    }
    CHECK(diagnostics.all().empty());
    const auto recorded = recorded_synapses(one.path / "topology.csv");
    REQUIRE(recorded.size() == system->connections.size());
    for (const auto& c : system->connections) {
        INFO("connection " << c.name << " (" << c.id << ")");
        REQUIRE(recorded.count(c.id) == 1);
        const Random random(c);
        if (random.any())
            comparison.statistics(c, recorded.at(c.id), random);
        else
            CHECK(first_difference(comparison.connect(c), recorded.at(c.id), random) == "");
    }
}

}  // namespace

TEST_CASE("Every recorded connection has the original's synapses, in its order, at its distances") {
    const auto all = test::cases();
    REQUIRE(all.size() > 200);
    for (const auto& one : all) DYNAMIC_SECTION(one.name) {
            compare(one);
        }
}
