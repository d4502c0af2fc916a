// The memory of sequential episodic control, driven by recorded operations, selects, stores, forgets and
// chooses what the original does.
#include <iostream>
#include <map>
#include <set>

#include "modules/sequential_episodic_control/decision.h"
#include "tests/support/catch.h"
#include "tests/support/recorded_cases.h"

using namespace forage;
using namespace forage::test;
using namespace forage::sec;

namespace {

using Path = std::filesystem::path;
using Fields = std::vector<std::string_view>;
using Row = std::vector<std::string>;

/// The recorded cases, by name. They are not part of the project.
std::map<std::string, Path> sec_cases() {
    std::map<std::string, Path> out;
    const auto folder = shared_dir() / "golden/sec";
    if (absent(folder)) return out;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.is_directory()) out.emplace(entry.path().filename().string(), entry.path());
    return out;
}

/// The rows of a table by the number in their first column.
std::map<int, std::vector<Row>> by_operation(const Path& path) {
    std::map<int, std::vector<Row>> out;
    if (!std::filesystem::exists(path)) return out;
    Rows rows(path);
    for (Fields f; rows.next(f);) out[number<int>(f[0])].emplace_back(f.begin(), f.end());
    return out;
}

const std::vector<Row>& at(const std::map<int, std::vector<Row>>& table, int operation) {
    static const std::vector<Row> none;
    const auto found = table.find(operation);
    return found == table.end() ? none : found->second;
}

struct Parameters {
    std::map<std::string, std::string> text;
    explicit Parameters(const Path& path) {
        Rows rows(path);
        for (Fields f; rows.next(f);) text[std::string(f[0])] = std::string(f[1]);
    }
    double real(const std::string& name) const { return number(text.at(name)); }
    Index integer(const std::string& name) const { return number<Index>(text.at(name)); }
};

Settings settings_of(const Parameters& p) {
    Settings s;
    s.sequential_bias = p.integer("sequential_bias") != 0;
    s.trigger_decay = p.real("alpha");
    s.trigger_increment = p.real("increment");
    s.absolute_threshold = p.real("theta_abs");
    s.relative_threshold = p.real("theta_rel");
    s.distance_constant = p.real("tau");
    s.forgotten_share = p.real("forget_ratio");
    s.softmax = p.text.at("policy") == "softmax";
    s.greedy = p.text.at("choice") == "argmax";
    const std::map<std::string, Forgetting> rules{
        {"NONE", Forgetting::none},          {"FIFO", Forgetting::oldest},
        {"SING", Forgetting::lowest_reward}, {"RWD", Forgetting::lowest_reward},
        {"PROP", Forgetting::lowest_share},  {"RWD-PROP", Forgetting::lowest_share},
        {"PRIOR", Forgetting::prioritized}};
    s.forgetting = rules.at(p.text.at("forget"));
    const std::map<std::string, ValueFunction> values{
        {"default", {true, true, true}}, {"noGi", {false, true, true}},    {"noDist", {true, true, false}},
        {"noRR", {true, false, true}},   {"soloGi", {true, false, false}}, {"soloDist", {false, false, true}},
        {"soloRR", {false, true, false}}};
    s.value = values.at(p.text.at("value_function"));
    return s;
}

/// The first difference between what is here and what was recorded.
struct SequentialComparison {
    std::string problem;
    std::size_t numbers = 0;
    void equal(const std::string& what, double ours, double recorded) {
        ++numbers;
        if (problem.empty() && !same(ours, recorded))
            problem = what + ": " + std::to_string(ours) + ", recorded " + std::to_string(recorded);
    }
};

void compare_retrieval(SequentialComparison& c, const std::string& where, const std::vector<Match>& matches,
                       const std::vector<Row>& recorded) {
    c.equal(where + "selected", static_cast<double>(matches.size()), static_cast<double>(recorded.size()));
    for (std::size_t i = 0; i < std::min(matches.size(), recorded.size()); ++i) {
        const auto& m = matches[i];
        c.equal(where + "sequence", static_cast<double>(m.sequence), number(recorded[i][1]));
        c.equal(where + "column", static_cast<double>(m.column), number(recorded[i][2]));
        c.equal(where + "collector", m.collector, number(recorded[i][3]));
        c.equal(where + "relative reward", m.relative_reward, number(recorded[i][4]));
        c.equal(where + "distance", m.distance, number(recorded[i][5]));
    }
}

void compare_policy(SequentialComparison& c, const std::string& where, const Decision& decision,
                    const std::vector<Row>& recorded) {
    std::set<Index> listed;
    for (const auto& row : recorded) {
        const auto a = number<Index>(row[1]);
        listed.insert(a);
        if (!row[2].empty()) c.equal(where + "Q", decision.values[a], number(row[2]));
        c.equal(where + "p", decision.policy[a], number(row[3]));
    }
    for (Index a = 0; a < decision.policy.size(); ++a)
        if (!listed.count(a)) c.equal(where + "p of an action that is not listed", decision.policy[a], 0);
}

void compare_triggers(SequentialComparison& c, const std::string& where, const EpisodicMemory& memory,
                      const std::vector<Row>& recorded) {
    std::map<std::pair<std::size_t, Index>, double> triggers;
    for (const auto& row : recorded)
        triggers[{number<std::size_t>(row[1]), number<Index>(row[2])}] = number(row[3]);
    for (std::size_t i = 0; i < memory.sequences().size(); ++i)
        for (Index j = 0; j < memory.segments(); ++j) {
            const auto found = triggers.find({i, j});
            c.equal(where + "trigger", memory.sequences()[i].triggers[j],
                    found == triggers.end() ? 1 : found->second);
        }
}

SequentialComparison play(const Path& path) {
    const Parameters p(path / "params.csv");
    const Settings settings = settings_of(p);
    const Index cells = p.integer("state_cells");
    EpisodicMemory memory(p.integer("stm_length"), p.integer("ltm_length"), cells);
    Decision decision(p.integer("action_rows") * p.integer("action_columns"));
    const auto expected = by_operation(path / "expected.csv"), selected = by_operation(path / "selected.csv"),
               policy = by_operation(path / "policy.csv"), triggers = by_operation(path / "triggers.csv"),
               rewards = by_operation(path / "rewards.csv");
    std::map<int, Eigen::ArrayXd> remembered;
    SequentialComparison c;
    Rows operations(path / "ops.csv");
    for (Fields f; operations.next(f) && c.problem.empty();) {
        const int op = number<int>(f[0]);
        const std::string where = "operation " + std::to_string(op) + ", ";
        const auto& row = at(expected, op).at(0);
        const bool drawn = !f[4].empty();
        bool used = false;
        const auto uniform = [&, u = drawn ? number(f[4]) : 0] { return used = true, u; };
        Eigen::ArrayXd state = Eigen::ArrayXd::Zero(cells);
        for (Index i = 0; i < cells && !f[5].empty(); ++i)
            state[i] = number(f[static_cast<std::size_t>(5 + i)]);
        if (f[1] == "remember") {
            memory.remember(state, number<int>(f[3]), settings);
            remembered[op] = state;
        } else if (f[1] == "store") {
            memory.store(number(f[2]), settings, uniform);
            const auto& all = at(rewards, op);
            c.equal(where + "rewards", static_cast<double>(memory.sequences().size()),
                    static_cast<double>(all.size()));
            for (std::size_t i = 0; i < all.size() && c.problem.empty(); ++i)
                c.equal(where + "reward", memory.sequences()[i].reward, number(all[i][2]));
        } else if (f[1] == "end_episode") {
            memory.end_episode();
        } else {
            const bool empty = memory.sequences().empty();
            const auto& matches = memory.retrieve(state, settings);
            if (!empty) decision.decide(matches, settings, uniform);
            compare_retrieval(c, where, matches, at(selected, op));
            c.equal(where + "action", decision.action, number(row[3]));
            if (!matches.empty()) {
                c.equal(where + "entropy", decision.entropy, number(row[4]));
                compare_policy(c, where, decision, at(policy, op));
            }
        }
        c.equal(where + "number drawn", used, drawn);
        c.equal(where + "sequences", static_cast<double>(memory.sequences().size()), number(row[1]));
        double sum = 0;
        for (const auto& s : memory.sequences()) sum += s.triggers.sum();
        c.equal(where + "sum of triggers", sum, number(row[5]));
        if (op % p.integer("triggers_every") == 0) compare_triggers(c, where, memory, at(triggers, op));
    }
    Rows last(path / "ltm_final.csv");
    for (Fields f; last.next(f) && c.problem.empty();) {
        const auto& s = memory.sequences().at(number<std::size_t>(f[0]));
        const auto j = number<Index>(f[1]);
        c.equal("last action", s.actions[static_cast<std::size_t>(j)], number(f[2]));
        c.equal("last reward", s.reward, number(f[3]));
        for (Index i = 0; i < cells; ++i) {
            const int op = number<int>(f[4]);
            c.equal("last state", s.states(i, j), op < 0 ? 0 : remembered.at(op)[i]);
        }
    }
    return c;
}

}  // namespace

TEST_CASE("Sequential episodic control selects, stores, forgets and chooses what was recorded") {
    const auto cases = sec_cases();
    if (cases.empty()) return;
    REQUIRE(cases.size() >= 19);
    std::size_t numbers = 0;
    for (const auto& [name, path] : cases) {
        INFO(name);
        const auto comparison = play(path);
        CHECK(comparison.problem == "");
        CHECK(comparison.numbers > 0);
        numbers += comparison.numbers;
    }
    std::cout << "sequential episodic control: " << cases.size() << " cases, " << numbers << " numbers met\n";
}
