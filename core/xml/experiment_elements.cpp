#include "core/xml/experiment_elements.h"

#include <array>

#include "core/model/experiment.h"

namespace forage::xml {
namespace {

AttributeRule amount(std::string_view name, std::string_view doc, double low = 1) {
    return whole(name, doc, low, 2e9);
}
AttributeRule positive(std::string_view name, std::string_view doc) { return number(name, doc, 1e-9, 1e9); }
AttributeRule file(std::string_view doc) { return relative_path(required(text("file", doc))); }
AttributeRule parameter() {
    return text("parameter",
                "'Process/Group.parameter', 'Process.parameter' of a module, 'Connection.parameter'");
}

/// The attributes of which a measure, or a requirement, has one, and 'of'.
std::vector<AttributeRule> kinds_of_measures(std::string_view doc_of_all = {}) {
    constexpr std::array<std::string_view, model::measure_kinds.size() + 1> docs = {
        "share of the trials that reached the target: 'all', or 'last N' trials",
        "mean seconds of a trial: of 'all', or of the 'last N' trials",
        "smallest distance to a target in a trial, in m: mean of 'all', or of the 'last N' trials",
        "a condition: the number of cycles until it first held",
        "a cell, or mean, sum, min or max of a column, at the end",
        "a condition: share of the trials in which it held",
        "a condition: the number of cycles in which it held",
        "a quantity as in 'final': its mean over all cycles",
        "a quantity as in 'final': its smallest value over all cycles",
        "a quantity as in 'final': its largest value over all cycles",
        "what a robot did, in all trials together",
        "a condition: share of the cycles in which it held",
        "arithmetic with the measures above, by their names: 'reached / tried', 'max(a, b) - 1'",
        "with 'robot': its name; without it, the first robot"};
    const auto doc = [&](std::size_t i) { return std::string(doc_of_all.empty() ? docs[i] : doc_of_all); };
    std::vector<AttributeRule> out;
    for (const char* kind : model::measure_kinds) out.push_back(alternative(text(kind, doc(out.size()))));
    auto& robot = out[static_cast<std::size_t>(model::Measure::Kind::robot)].value;
    robot.kind = ValueKind::choice;
    robot.choices = {model::robot_quantities.begin(), model::robot_quantities.end()};
    out.push_back(text("of", doc(out.size())));
    return out;
}

ElementRow manipulation(std::string_view name, std::string_view doc) {
    using M = model::ManipulationSpec;
    return element<M>(
        {std::string(name), std::string(doc)},
        {{&M::group, required(text("group", "'Process/Group', whose activity it is"))},
         {&M::cells, alternative(text("cells", "a pattern: '(1,1)=0.5 (2,1)=1'"))},
         {&M::patterns, alternative(relative_path(
                            text("patterns", "a file with a list of patterns, as seen from this one")))},
         {&M::every, amount("every", "cycles from one pattern to the next")},
         {&M::step, amount("step", "only every n-th pattern of the list")},
         {&M::times, amount("times", "how often the list is played; without it, for ever")},
         {&M::backwards, flag("backwards", "from the last pattern to the first")},
         {&M::from, text("from", "a condition, when it begins")},
         {&M::until, text("until", "a condition, when it ends")}});
}

std::vector<ElementRow> experiment_rows() {
    using namespace model;
    return {
        ElementRule{"experiment", "a system, run many times",
                    "note? system world? bind length! seeds? set at clamp add multiply record plot measure "
                    "sweep together confidence? halving? exercise?"},
        ElementRule{"note", "a text for people", ":text"},
        element<Expression>({"system", "what is run; several systems run together", ""},
                            {{&Expression::text, file("an .iqr or .iqrProcess file, as seen from this one"),
                              &Expression::at}}),
        element<Experiment>(
            {"world", "where the robot lives", ""},
            {{&Experiment::world, file("a .world file, as seen from this one"), &Experiment::world_at},
             {&Experiment::real_time_factor,
              positive("pace", "seconds of the world per second of the clock, instead of the world's own")},
             {&Experiment::noise, flag("noise", "of motors and sensors")}}),
        ElementRule{"bind",
                    "lets a robot of a system be another robot of the world; when several systems have it, "
                    "the first one that is not yet bound",
                    "",
                    {required(text("robot", "the system's robot: the device_name of a module")),
                     required(text("to", "the world's robot"))}},
        element<Experiment>(
            {"length", "how long a run is: cycles, seconds or trials", ""},
            {{&Experiment::cycles, alternative(amount("cycles", "number of cycles"))},
             {&Experiment::seconds, alternative(positive("seconds", "seconds of the world"))},
             {&Experiment::trials, alternative(amount("trials", "number of trials"))},
             {&Experiment::trial_timeout,
              positive("longest-trial", "a run ends when a trial takes longer, in seconds of the world")},
             {&Experiment::until, text("until", "a condition that ends a run before its time")}}),
        ElementRule{"seeds",
                    "what decides everything random: every combination runs once with each",
                    "",
                    {amount("first", "the first seed", 0), amount("count", "how many, one after the other"),
                     text("list", "or all of them, with blanks between")}},
        ElementRule{"set",
                    "a parameter in all runs",
                    "",
                    {required(parameter()), required(text("value", "its value"))}},
        ElementRule{"at",
                    "a parameter that changes while the system runs",
                    "",
                    {required(text("when", "a condition; the change is made once, when it first holds")),
                     required(parameter()), required(text("value", "its new value"))}},
        manipulation("clamp", "patterns that a group's activity becomes, right after its update"),
        manipulation("add", "patterns that are added to a group's activity, right after its update"),
        manipulation("multiply",
                     "patterns by which a group's activity is multiplied, right after its update"),
        element<RecordingSpec>(
            {"record", "a table of every run", ""},
            {{&RecordingSpec::column, required(text("column", "'Process/Group' or 'Process/Group:state'"))},
             {&RecordingSpec::every, amount("every", "only each k-th cycle")},
             {&RecordingSpec::format,
              choice("format", "of the file; without it, csv", {"csv", "npy", "npz", "h5", "dat"})}}),
        element<Expression>(
            {"plot", "a picture of every run", ""},
            {{&Expression::text,
              required(text("what",
                            "'time:SOURCE', 'space:SOURCE@CYCLES', 'movie:SOURCE', 'connection:NAME', "
                            "'diagram' or 'trajectory', as for --plot")),
              &Expression::at}}),
        element<Measure>(
            {"measure", "a number that every run gives", ""},
            {{&Measure::name, required(text("name", "its column in the table of results")), &Measure::at}},
            kinds_of_measures()),
        ElementRule{
            "sweep",
            "a parameter that takes several values, or systems; several sweeps give every combination",
            "",
            {alternative(parameter()), text("values", "with blanks between"),
             alternative(text("systems",
                              ".iqr files, as seen from this one, with blanks between: one runs at "
                              "a time"))}},
        ElementRule{"together",
                    "sweeps that take their values together, the first of each, the second of each, ...",
                    "sweep+"},
        element<Adaptation>(
            {"confidence", "adds seeds to each combination until the mean of a measure is known well enough",
             ""},
            {{&Adaptation::measure, required(text("measure", "the name of the measure"))},
             {&Adaptation::width,
              positive("width", "of the 95 % interval of the mean, in the unit of the measure")},
             {&Adaptation::relative_width,
              positive("relative-width", "or the width as a share of the mean, such as 0.1")},
             {&Adaptation::most, amount("most", "seeds of a combination")}}),
        element<Adaptation>(
            {"halving",
             "searches the best combination: in every round the better half gets twice as many seeds", ""},
            {{&Adaptation::measure, required(text("measure", "the name of the measure"))},
             {&Adaptation::lowest,
              choice("keep", "which numbers of the measure are good", {"highest", "lowest"})}}),
        element<Exercise>(
            {"exercise",
             "what a system of one's own must have and do: 'forage tutorial NUMBER --system FILE'",
             "require"},
            {{&Exercise::start,
              relative_path(
                  required(text("start", "the .iqr file that users complete, as seen from this one"))),
              &Exercise::start_at}}),
        element<Requirement>(
            {"require",
             "a number within bounds; the text says what may be wrong, with {n}, {all} and {value}", ":text"},
            {{&Requirement::what,
              required(text("what", "what is required, such as 'the robot reaches the light'"))},
             {&Requirement::to,
              text("to", "'Process/Group' or some of its cells: the number of synapses to them")},
             {&Requirement::from, text("from", "where the synapses come from; without it, from anywhere")},
             {&Requirement::kind,
              choice("kind", "of the synapses", {input_kind_names.begin(), input_kind_names.end()})},
             {&Requirement::at_least,
              number("at-least", "the lowest number that is accepted; for synapses 1 if no bound is given")},
             {&Requirement::at_most, number("at-most", "the highest number that is accepted")}},
            kinds_of_measures("as in a measure"))};
}

}  // namespace

const std::vector<ElementRow>& experiment_elements() {
    static const auto elements = experiment_rows();
    return elements;
}

}  // namespace forage::xml
