// The elements and attributes of experiment files.
#include "core/model/experiment.h"
#include "core/xml/rules.h"

namespace forage::xml {
namespace {

AttributeRule amount(std::string name, std::string doc, double low = 1) {
    return whole(std::move(name), std::move(doc), low, 2e9);
}
AttributeRule positive(std::string name, std::string doc) {
    return number(std::move(name), std::move(doc), 1e-9, 1e9);
}
AttributeRule file(std::string doc) { return required(text("file", std::move(doc))); }

Format make_format() {
    const AttributeRule parameter = required(text(
        "parameter", "'Process/Group.parameter', 'Process.parameter' of a module, 'Connection.parameter'"));
    const std::vector<AttributeRule> manipulation = {
        required(text("group", "'Process/Group', whose activity it is")),
        text("cells", "a pattern: '(1,1)=0.5 (2,1)=1'"),
        text("patterns", "a file with a list of patterns, as seen from this one"),
        amount("every", "cycles from one pattern to the next"),
        amount("step", "only every n-th pattern of the list"),
        amount("times", "how often the list is played; without it, for ever"),
        flag("backwards", "from the last pattern to the first"),
        text("from", "a condition, when it begins"),
        text("until", "a condition, when it ends")};
    return Format{
        .name = "an experiment file",
        .beginning = "<experiment>",
        .roots = {"experiment"},
        .where_texts_stand = "write a text in the <note>, and a remark in <!-- -->",
        .values = {{"text", {}}},
        .elements =
            {{"experiment", "a system, run many times",
              "note? system world? bind length! seeds? set at clamp add multiply record plot measure sweep "
              "together confidence? halving? exercise?"},
             {"note", "a text for people", ":text"},
             {"system",
              "what is run; several systems run together",
              "",
              {file("an .iqr or .iqrProcess file, as seen from this one")}},
             {"world",
              "where the robot lives",
              "",
              {file("a .world file, as seen from this one"),
               positive("pace", "seconds of the world per second of the clock, instead of the world's own"),
               flag("noise", "of motors and sensors")}},
             {"bind",
              "lets a robot of a system be another robot of the world; when several systems have it, the "
              "first one that is not yet bound",
              "",
              {required(text("robot", "the system's robot: the device_name of a module")),
               required(text("to", "the world's robot"))}},
             {"length",
              "how long a run is: cycles, seconds or trials",
              "",
              {amount("cycles", "number of cycles"), positive("seconds", "seconds of the world"),
               amount("trials", "number of trials"),
               positive("longest-trial", "a run ends when a trial takes longer, in seconds of the world"),
               text("until", "a condition that ends a run before its time")}},
             {"seeds",
              "what decides everything random: every combination runs once with each",
              "",
              {amount("first", "the first seed", 0), amount("count", "how many, one after the other"),
               text("list", "or all of them, with blanks between")}},
             {"set", "a parameter in all runs", "", {parameter, required(text("value", "its value"))}},
             {"at",
              "a parameter that changes while the system runs",
              "",
              {required(text("when", "a condition; the change is made once, when it first holds")), parameter,
               required(text("value", "its new value"))}},
             {"clamp", "patterns that a group's activity becomes, right after its update", "", manipulation},
             {"add", "patterns that are added to a group's activity, right after its update", "",
              manipulation},
             {"multiply", "patterns by which a group's activity is multiplied, right after its update", "",
              manipulation},
             {"record",
              "a table of every run",
              "",
              {required(text("column", "'Process/Group' or 'Process/Group:state'")),
               amount("every", "only each k-th cycle")}},
             {"plot",
              "a picture of every run",
              "",
              {required(text("what",
                             "'time:SOURCE', 'space:SOURCE@CYCLES', 'movie:SOURCE', 'connection:NAME', "
                             "'diagram' or 'trajectory', as for --plot"))}},
             {"measure",
              "a number that every run gives",
              "",
              {required(text("name", "its column in the table of results")),
               text("success", "share of the trials that reached the target: 'all', or 'last N' trials"),
               text("duration", "mean seconds of a trial: of 'all', or of the 'last N' trials"),
               text("distance",
                    "smallest distance to a target in a trial, in m: mean of 'all', or of the 'last N' "
                    "trials"),
               text("trials", "a condition: share of the trials in which it held"),
               text("cycles", "a condition: the number of cycles in which it held"),
               text("first", "a condition: the number of cycles until it first held"),
               text("final", "a cell, or mean, sum, min or max of a column, at the end"),
               text("mean", "a quantity as in 'final': its mean over all cycles"),
               text("minimum", "a quantity as in 'final': its smallest value over all cycles"),
               text("maximum", "a quantity as in 'final': its largest value over all cycles"),
               choice("robot", "what a robot did, in all trials together",
                      {model::robot_quantities.begin(), model::robot_quantities.end()}),
               text("of", "with 'robot': its name; without it, the first robot")}},
             {"sweep",
              "a parameter that takes several values, or systems; several sweeps give every combination",
              "",
              {text("parameter", parameter.value.doc), text("values", "with blanks between"),
               text("systems",
                    ".iqr files, as seen from this one, with blanks between: one runs at a time")}},
             {"together",
              "sweeps that take their values together, the first of each, the second of each, ...", "sweep+"},
             {"confidence",
              "adds seeds to each combination until the mean of a measure is known well enough",
              "",
              {required(text("measure", "the name of the measure")),
               positive("width", "of the 95 % interval of the mean, in the unit of the measure"),
               positive("relative-width", "or the width as a share of the mean, such as 0.1"),
               otherwise("100", amount("most", "seeds of a combination"))}},
             {"halving",
              "searches the best combination: in every round the better half gets twice as many seeds",
              "",
              {required(text("measure", "the name of the measure")),
               otherwise("highest",
                         choice("keep", "which numbers of the measure are good", {"highest", "lowest"}))}},
             {"exercise",
              "what a system of one's own must have and do: 'forage tutorial NUMBER --system FILE'",
              "require",
              {required(text("start", "the .iqr file that users complete, as seen from this one"))}},
             {"require",
              "a number within bounds; the text says what may be wrong, with {n}, {all} and {value}",
              ":text",
              {required(text("what", "what is required, such as 'the robot reaches the light'")),
               text("success", "as in a measure"), text("duration", "as in a measure"),
               text("distance", "as in a measure"), text("trials", "as in a measure"),
               text("cycles", "as in a measure"), text("first", "as in a measure"),
               text("final", "as in a measure"), text("mean", "as in a measure"),
               text("minimum", "as in a measure"), text("maximum", "as in a measure"),
               choice("robot", "as in a measure",
                      {model::robot_quantities.begin(), model::robot_quantities.end()}),
               text("of", "as in a measure"),
               text("to", "'Process/Group' or some of its cells: the number of synapses to them"),
               text("from", "where the synapses come from; without it, from anywhere"),
               choice("kind", "of the synapses", {"excitatory", "inhibitory", "modulatory"}),
               number("at-least", "the lowest number that is accepted; for synapses 1 if no bound is given"),
               number("at-most", "the highest number that is accepted")}}}}
        .link();
}

}  // namespace

const Format& experiment_format() {
    static const Format table = make_format();
    return table;
}

}  // namespace forage::xml
