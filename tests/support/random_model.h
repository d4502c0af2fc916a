// Random systems that are valid, with every construct of the format.
#pragma once

#include <random>
#include <string>

#include "core/connectivity/connect.h"
#include "core/model/build.h"

namespace forage::test {

class RandomModel {
  public:
    /// With this seed of the simulation every connection has synapses.
    static constexpr std::uint64_t connection_seed = 1;

    explicit RandomModel(std::uint64_t seed) : random_(seed) {}

    model::System make() {
        model::System s;
        s.id = "system", s.name = text(), s.author = text(), s.date = text();
        s.cycles_per_second = pick({0.0, 25.0, 12.5, 60.0});
        s.sync_plots = chance(0.5);
        if (chance(0.5)) s.port = "54923";
        s.note = maybe_text();
        s.comments = comments();
        for (int p = 1 + below(3); p > 0; --p) add_process(s);
        for (int c = below(6); c > 0; --c) add_connection(s);
        add_canvas_parts(s);
        return s;
    }

  private:
    int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
    int from_to(int low, int high) { return low + below(high - low + 1); }
    bool chance(double p) { return std::bernoulli_distribution(p)(random_); }
    double real(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    template <class T>
    T pick(std::initializer_list<T> values) {
        return *(values.begin() + below(static_cast<int>(values.size())));
    }

    /// A text as users may write it: markup, quotes, other alphabets, several lines.
    std::string text() {
        std::string out;
        for (int n = below(4); n > 0; --n)
            out += pick<std::string>(
                {"Motor", " ", "<b>", "&amp;", "\"", "'", "größer", "前", "a\nb", "x > y", "]]>", "#1", "%"});
        return out + "t";
    }
    std::optional<std::string> maybe_text() {
        if (chance(0.5)) return std::nullopt;
        return chance(0.2) ? std::string() : text();
    }
    std::vector<std::string> comments() {
        std::vector<std::string> out;
        if (chance(0.2)) out.push_back(" " + pick<std::string>({"why", "TO DO: <here>", "a - b & c"}) + " ");
        return out;
    }
    std::optional<model::Icon> icon() {
        if (chance(0.3)) return std::nullopt;
        return model::Icon{from_to(-50, 500), from_to(-50, 500), from_to(10, 90), from_to(10, 90)};
    }
    std::string number(double low, double high) {
        return to_text(chance(0.3) ? pick({0.0, 0.5, 1.0}) : real(low, high));
    }

    void add_process(model::System& s) {
        auto& p = *model::find_process(s, model::add_process(s, text()));
        p.color = chance(0.5) ? "#12AB34" : "";
        p.hostname = chance(0.2) ? "host" : "";
        p.module_enabled = chance(0.7);
        p.note = maybe_text();
        p.icon = icon();
        p.comments = comments();
        const std::string id = p.id;
        for (int g = from_to(1, 3); g > 0; --g) add_group(s, id);
    }

    void add_group(model::System& s, const std::string& process) {
        const auto type = pick<std::string>({"neuronLinearThreshold", "neuronRandomSpike",
                                             "neuronIntegrateFire", "neuronSigmoid",
                                             "neuronPyramidApicalShunt", "neuronNumeric", "neuronTDValue"});
        auto& g =
            *model::find_group(s, model::add_group(s, process, text(), from_to(1, 7), from_to(1, 7), type));
        if (chance(0.2))
            g.topology = sparse();
        else if (auto* rect = std::get_if<model::RectTopology>(&g.topology))
            rect->wrap_x = chance(0.2), rect->wrap_y = chance(0.2);
        g.color = chance(0.5) ? "#FFFFFF" : "";
        g.note = maybe_text();
        g.icon = icon();
        g.comments = comments();
        g.neuron.note = maybe_text();
        if (type == "neuronLinearThreshold" || type == "neuronIntegrateFire") {
            if (chance(0.5)) model::set_parameter(g.neuron, "probability", number(0, 1));
            if (chance(0.5)) model::set_parameter(g.neuron, "threshold", number(0, 1));
            if (chance(0.5)) model::set_parameter(g.neuron, "vmPrs", number(0, 1));
            if (chance(0.3)) model::set_parameter(g.neuron, "clipVm", "true");
        }
        if (type == "neuronNumeric" && chance(0.3))
            g.neuron.initial.push_back(
                {"act", pick<std::string>({"0.5", "normal(0, 0.1)", "uniform(0, 1)"})});
        if (type == "neuronRandomSpike") model::set_parameter(g.neuron, "probability", number(0, 1));
    }

    model::SparseTopology sparse() {
        model::SparseTopology out;
        for (int y = 1; y <= 4; ++y)
            for (int x = 1; x <= 5; ++x)
                if (chance(0.4)) out.points.push_back({x, y, {}});
        if (out.points.empty()) out.points.push_back({2, 2, {}});
        std::shuffle(out.points.begin(), out.points.end(), random_);
        return out;
    }

    model::Point point_in(const model::Topology& t) {
        if (const auto* s = std::get_if<model::SparseTopology>(&t))
            return s->points[static_cast<std::size_t>(below(static_cast<int>(s->points.size())))];
        const auto& r = std::get<model::RectTopology>(t);
        return {from_to(1, r.width), from_to(1, r.height), {}};
    }
    std::vector<model::Point> points_in(const model::Topology& t) {
        std::vector<model::Point> out;
        for (int n = from_to(1, 4); n > 0; --n) out.push_back(point_in(t));
        return out;
    }
    model::Population population(const model::Topology& t, bool lists) {
        const auto shape = model::shape(t);
        if (lists && chance(0.3)) return model::List{points_in(t), {}};
        if (chance(0.4)) {
            const int w = from_to(1, shape.width), h = from_to(1, shape.height);
            return model::Region{from_to(1, shape.width - w + 1), from_to(1, shape.height - h + 1), w, h, {}};
        }
        return model::All{};
    }

    void add_connection(model::System& s) {
        std::vector<std::pair<std::string, model::Group>> groups;
        for (const auto& p : s.processes)
            for (const auto& g : p.groups) groups.emplace_back(g.id, g);
        const auto any = [&] {
            return groups[static_cast<std::size_t>(below(static_cast<int>(groups.size())))];
        };
        const auto [source_id, source] = any();
        const auto [target_id, target] = any();
        const bool pyramid = target.neuron.type == "neuronPyramidApicalShunt";
        const auto kind = pick({InputKind::excitatory, InputKind::inhibitory, InputKind::modulatory});
        const auto id = model::add_connection(
            s, source_id, target_id, kind,
            pick<std::string>({"synapseFixedWeight", "synapseFixedWeight", "synapseUniformFixedWeight",
                               "synapseHebbian", pyramid ? "synapseApicalShunt" : "synapseFixedWeight"}));
        auto& c = *model::find_connection(s, id);
        c.name = text();
        if (c.synapse->type.ends_with("Weight")) model::set_parameter(*c.synapse, "weight", number(-1, 1));
        if (c.synapse->type == "synapseHebbian")
            c.synapse->feedback.push_back(
                {"postact", target.neuron.type == "neuronTDValue" ? "value" : "act", {}});
        if (c.synapse->type == "synapseApicalShunt")
            c.synapse->feedback.push_back({"apicalShunt", "shunt", {}});
        c.synapse->note = maybe_text();
        c.note = maybe_text();
        c.comments = comments();
        c.pattern = pattern(source.topology, target.topology);
        c.arborization = arborization();
        c.attenuation = function(false);
        c.delay = function(true);
        if (chance(0.15) && c.synapse->type != "synapseApicalShunt")
            give_weights(c, model::shape(source.topology).cells, model::shape(target.topology).cells);
        if (chance(0.2))
            c.line.reset();
        else
            c.line = model::Line{below(16), below(16), points_in(source.topology)};
        if (c.line && chance(0.3)) c.line->source_vertices = points_in(source.topology);
        if (c.line && chance(0.3)) c.line->target_vertices = points_in(target.topology);
        Diagnostics diagnostics;
        connectivity::connect(c, source.topology, target.topology, connection_seed, diagnostics);
        if (diagnostics.failed()) model::remove(s, id);  // no synapses
    }

    /// Makes a connection one with weights, as a matrix or as a list.
    void give_weights(model::Connection& c, int sources, int targets) {
        model::Weights out;
        out.is_list = chance(0.3);
        for (int t = 0; t < targets; ++t) {
            for (int s = 0; s < sources; ++s) {
                const bool none = chance(0.2);
                const auto weight = number(-1, 1);
                if (out.is_list && !none)
                    out.text += std::to_string(s) + " " + std::to_string(t) + " " + weight + "\n";
                else if (!out.is_list)
                    out.text += (none ? "nan" : weight) + " ";
            }
            if (!out.is_list) out.text += "\n";
        }
        out.array.array =
            Array::parse(out.text, out.is_list ? Array::Form::list : Array::Form::matrix, out.text_at);
        c.pattern = out, c.arborization = {}, c.attenuation = {}, c.delay = {};
    }

    /// Comments on the pages, and places of the phantoms of groups of other processes.
    void add_canvas_parts(model::System& s) {
        for (int n = below(4); n > 0; --n) {
            const auto page = static_cast<std::size_t>(below(static_cast<int>(s.processes.size()) + 1));
            const model::Icon box{from_to(-50, 500), from_to(-50, 500), from_to(1, 90), from_to(1, 90)};
            const auto id = page == 0 ? std::string() : s.processes[page - 1].id;
            model::add_canvas_comment(s, id,
                                      {"",
                                       text() + pick<std::string>({"", " -- ", "-->", "\r\n"}),
                                       maybe_text().value_or(""),
                                       box,
                                       {}});
        }
        for (auto& p : s.processes)
            for (const auto& other : s.processes)
                if (&p != &other && chance(0.3))
                    p.phantoms.push_back({other.groups.front().id, from_to(-50, 500), from_to(-50, 500)});
    }

    model::Pattern pattern(const model::Topology& source, const model::Topology& target) {
        switch (below(3)) {
            case 0:
                return model::MappedPattern{chance(0.5), population(source, false),
                                            population(target, false)};
            case 1:
                return model::ForeachPattern{population(source, true), population(target, true)};
            default: {
                model::TuplesPattern out;
                for (int n = from_to(1, 3); n > 0; --n)
                    out.tuples.push_back({points_in(source), points_in(target)});
                return out;
            }
        }
    }

    model::Arborization arborization() {
        model::Arborization a;
        switch (below(6)) {
            case 0:
                a.shape = model::RectArbor{from_to(1, 4), from_to(1, 4)};
                break;
            case 1:
                a.shape = model::EllipseArbor{from_to(1, 5), from_to(1, 5)};
                break;
            case 2:
                a.shape = model::RectWindowArbor{1, from_to(1, 2), 3, from_to(3, 4)};
                break;
            case 3:
                a.shape = model::EllipseWindowArbor{1, 1, from_to(3, 5), from_to(3, 5)};
                break;
            case 4:
                a.shape = model::AllArbor{};
                break;
            default:
                a.shape = model::RandomArbor{from_to(1, 4)};
        }
        if (chance(0.4)) a.direction = model::Direction::projective;
        if (chance(0.3)) a.probability = real(0.2, 1);
        return a;
    }

    model::DistanceFunction function(bool delay) {
        const double low = delay ? from_to(0, 3) : real(0, 0.5), high = delay ? from_to(3, 7) : real(0.5, 1);
        switch (below(5)) {
            case 0:
                return {model::UniformFunction{low}, {}};
            case 1:
                return {model::LinearFunction{low, high}, {}};
            case 2:
                return {model::GaussianFunction{low, high, real(0.5, 3)}, {}};
            case 3:
                return {model::BlockFunction{low, high, from_to(0, 5), chance(0.3) ? 2 : 0}, {}};
            default:
                return {model::RandomFunction{high}, {}};
        }
    }

    std::mt19937_64 random_;
};

}  // namespace forage::test
